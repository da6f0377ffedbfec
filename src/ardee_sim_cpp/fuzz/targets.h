// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace ardee::fuzz {

/// A part of the library that is fed with the bytes of a file or text of its users.
struct Target {
  const char* name;
  void (*run)(const std::string& input);
};

/// All targets, one line each in targets.cpp.
const std::vector<Target>& targets();

/// Returns the target of that name, or nullptr.
const Target* find_target(const std::string& name);

/// Returns whether the target takes the input; an Error refuses it. Any other exception is passed
/// on: it is a finding, as is a crash.
bool accepts(const Target& target, const std::string& input);

void read_world(const std::string& input);
void read_model(const std::string& input);
/// The first byte names the format: s STL, o OBJ, d DAE, p PLY, g glTF, b glTF in one file.
void read_mesh(const std::string& input);
void read_image(const std::string& input);
void read_material(const std::string& input);
void read_instances(const std::string& input);
/// A GPS plugin, or a file of plots and noise bands.
void read_gps(const std::string& input);
/// A world, a model, or an <sdf> with both: loaded, spawned, stepped, commanded, reset.
void simulate(const std::string& input);
/// Settings of ros_control as XML (control_robot.cpp): a controller is loaded with them, started,
/// stepped, commanded, reset, stopped, unloaded.
void control_robot(const std::string& input);

}  // namespace ardee::fuzz
