// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/material_script.h"

namespace ardee {
namespace {

struct Entry {
  const char* name;
  Eigen::Vector3f ambient;
  Eigen::Vector3f diffuse;
  float opacity = 1.0f;
};

Color opaque(const Eigen::Vector3f& rgb, float opacity = 1.0f) {
  return {rgb.x(), rgb.y(), rgb.z(), opacity};
}

/// After Gazebo Classic's media/materials/scripts/gazebo.material; textured ones by the mean colour
/// of their picture.
const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      {"Gazebo/Grey", {0.3f, 0.3f, 0.3f}, {0.7f, 0.7f, 0.7f}},
      {"Gazebo/Gray", {0.3f, 0.3f, 0.3f}, {0.7f, 0.7f, 0.7f}},
      {"Gazebo/DarkGrey", {0.175f, 0.175f, 0.175f}, {0.175f, 0.175f, 0.175f}},
      {"Gazebo/DarkGray", {0.175f, 0.175f, 0.175f}, {0.175f, 0.175f, 0.175f}},
      {"Gazebo/LightGrey", {0.6f, 0.6f, 0.6f}, {0.8f, 0.8f, 0.8f}},
      {"Gazebo/White", {1, 1, 1}, {1, 1, 1}},
      {"Gazebo/FlatBlack", {0.1f, 0.1f, 0.1f}, {0.1f, 0.1f, 0.1f}},
      {"Gazebo/Black", {0, 0, 0}, {0, 0, 0}},
      {"Gazebo/Red", {1, 0, 0}, {1, 0, 0}},
      {"Gazebo/RedBright", {0.87f, 0.26f, 0.07f}, {0.87f, 0.26f, 0.07f}},
      {"Gazebo/Green", {0, 1, 0}, {0, 1, 0}},
      {"Gazebo/Blue", {0, 0, 1}, {0, 0, 1}},
      {"Gazebo/SkyBlue", {0.13f, 0.44f, 0.70f}, {0, 0, 1}},
      {"Gazebo/Yellow", {1, 1, 0}, {1, 1, 0}},
      {"Gazebo/ZincYellow", {0.9725f, 0.9529f, 0.2078f}, {0.9725f, 0.9529f, 0.2078f}},
      {"Gazebo/DarkYellow", {0.7f, 0.7f, 0}, {0.7f, 0.7f, 0}},
      {"Gazebo/Gold", {0.8f, 0.64869f, 0.120759f}, {0.8f, 0.64869f, 0.120759f}},
      {"Gazebo/Orange", {1.0f, 0.5088f, 0.0468f}, {1.0f, 0.5088f, 0.0468f}},
      {"Gazebo/Purple", {1, 0, 1}, {1, 0, 1}},
      {"Gazebo/Turquoise", {0, 1, 1}, {0, 1, 1}},
      {"Gazebo/Indigo", {0.33f, 0, 0.5f}, {0.33f, 0, 0.5f}},
      {"Gazebo/DarkOrange", {0.713f, 0.2f, 0}, {0.713f, 0.2f, 0}},
      {"Gazebo/DarkMagenta", {0.5f, 0, 0.5f}, {0.5f, 0, 0.5f}},
      {"Gazebo/Residential", {0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, 0.5f}},
      {"Gazebo/Wood", {0.52f, 0.37f, 0.26f}, {0.52f, 0.37f, 0.26f}},
      {"Gazebo/WoodFloor", {0.52f, 0.37f, 0.26f}, {0.52f, 0.37f, 0.26f}},
      {"Gazebo/WoodPallet", {0.6f, 0.48f, 0.33f}, {0.6f, 0.48f, 0.33f}},
      {"Gazebo/Bricks", {0.5f, 0.3f, 0.25f}, {0.5f, 0.3f, 0.25f}},
      {"Gazebo/Road", {0.25f, 0.25f, 0.25f}, {0.25f, 0.25f, 0.25f}},
      {"Gazebo/Grass", {0.25f, 0.4f, 0.15f}, {0.25f, 0.4f, 0.15f}},
      {"Gazebo/GrayGrid", {0.7f, 0.7f, 0.7f}, {0.7f, 0.7f, 0.7f}},
      {"Gazebo/CeilingTiled", {0.85f, 0.85f, 0.85f}, {0.85f, 0.85f, 0.85f}},
      {"Gazebo/RedTransparent", {1, 0, 0}, {1, 0, 0}, 0.5f},
      {"Gazebo/GreenTransparent", {0, 1, 0}, {0, 1, 0}, 0.5f},
      {"Gazebo/BlueTransparent", {0, 0, 1}, {0, 0, 1}, 0.5f},
      {"Gazebo/YellowTransparent", {1, 1, 0}, {1, 1, 0}, 0.5f},
      {"Gazebo/OrangeTransparent", {1, 0.44f, 0}, {1, 0.44f, 0}, 0.4f},
      {"Gazebo/BlackTransparent", {0, 0, 0}, {0, 0, 0}, 0.5f},
      {"Gazebo/DarkOrangeTransparent", {0.713f, 0.2f, 0}, {0.713f, 0.2f, 0}, 0.4f},
      {"Gazebo/DarkMagentaTransparent", {0.5f, 0, 0.5f}, {0.5f, 0, 0.5f}, 0.4f},
  };
  return all;
}

/// The glowing materials: Gazebo/RedGlow and so on.
void add_glowing(MaterialScript& script) {
  for (const auto& [name, rgb] : {std::pair<const char*, Eigen::Vector3f>{"Red", {1, 0, 0}},
                                  {"Green", {0, 1, 0}},
                                  {"Blue", {0, 0, 1}},
                                  {"Yellow", {1, 1, 0}},
                                  {"Purple", {1, 0, 1}},
                                  {"Turquoise", {0, 1, 1}},
                                  {"White", {1, 1, 1}}}) {
    Material material;
    material.name = "Gazebo/" + std::string(name) + "Glow";
    material.ambient = material.diffuse = material.emissive = opaque(rgb);
    script[material.name] = material;
  }
}

}  // namespace

const MaterialScript& gazebo_materials() {
  static const MaterialScript script = [] {
    MaterialScript made;
    for (const Entry& entry : entries()) {
      Material material;
      material.name = entry.name;
      material.ambient = opaque(entry.ambient, entry.opacity);
      material.diffuse = opaque(entry.diffuse, entry.opacity);
      made[material.name] = material;
    }
    add_glowing(made);
    return made;
  }();
  return script;
}

}  // namespace ardee
