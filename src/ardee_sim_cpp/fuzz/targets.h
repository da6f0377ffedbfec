// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace ardee::fuzz {

/// Part of the library that receives the bytes of a user's file or text.
struct Target {
  const char* name;
  void (*run)(const std::string& input);
};

/// Returns all targets, one line each in targets.cpp.
const std::vector<Target>& targets();

/// Returns the target of that name, or nullptr.
const Target* find_target(const std::string& name);

/// Returns whether the target accepts the input; an Error refuses it. Any other exception is passed
/// on: it is a finding, as is a crash.
bool accepts(const Target& target, const std::string& input);

void read_world(const std::string& input);
void read_model(const std::string& input);
/// Reads a mesh. The first byte names the format: s STL, o OBJ, d DAE, p PLY, g glTF, b glTF in one
/// file.
void read_mesh(const std::string& input);
void read_image(const std::string& input);
void read_material(const std::string& input);
void read_instances(const std::string& input);
/// Reads a GPS plugin, or a file of plots and noise bands.
void read_gps(const std::string& input);
/// Runs a world, a model, or an <sdf> with both: loaded, spawned, stepped, commanded, reset.
void simulate(const std::string& input);
/// Runs a controller with settings of ros_control as XML (control_robot.cpp): loaded, started,
/// stepped, commanded, reset, stopped, unloaded.
void control_robot(const std::string& input);

}  // namespace ardee::fuzz
