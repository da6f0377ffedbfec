// SPDX-License-Identifier: MIT
#include <map>

#include "ardee_sim/image/image.h"
#include "ardee_sim/readers/heightmap_reader.h"
#include "ardee_sim/readers/instance_table.h"
#include "ardee_sim/readers/material_script.h"
#include "ardee_sim/readers/mesh_reader.h"
#include "fuzz/inputs.h"
#include "fuzz/targets.h"

namespace ardee::fuzz {
namespace {

const Source kSource{"fuzz.world", 1, "uri"};

}  // namespace

void read_mesh(const std::string& input) {
  static const std::map<char, std::string> kExtensions = {
      {'s', "stl"}, {'o', "obj"}, {'d', "dae"}, {'p', "ply"}, {'g', "gltf"}, {'b', "glb"}};
  const auto extension = input.empty() ? kExtensions.end() : kExtensions.find(input.front());
  if (extension == kExtensions.end()) throw Error(kSource, "found no letter of a format");
  Log log = quiet_log();
  read_mesh_file(write_input("mesh." + extension->second, input.substr(1)), kSource, log);
}

void read_image(const std::string& input) {
  // The first bytes name the format; only TGA, which has none, needs the file's name.
  const std::string path = write_input("image.tga", input);
  try {
    read_color_image(path, kSource);
  } catch (const Error&) {
    // The file may still be an elevation file.
  }
  Log log = quiet_log();
  read_height_grid(path, {10.0, 10.0, 1.0}, kSource, log);
}

void read_material(const std::string& input) {
  Log log = quiet_log();
  parse_material_script(input, "fuzz.material", log, gazebo_materials());
}

void read_instances(const std::string& input) {
  read_instance_table(write_input("plants.csv", input), kSource, [](const InstanceRow&) {});
}

}  // namespace ardee::fuzz
