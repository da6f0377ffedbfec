// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ardee_sim/core/pose.h"

namespace ardee {

/// Command-line arguments of render_world, in SI units.
struct RenderArguments {
  std::string world;
  std::string output;
  std::optional<Pose> camera_W;  // none: the world's own, or a view of the whole world
  int width = 1280;
  int height = 720;
  double horizontal_fov_rad = 0.0;
  std::string robot;                     // URDF or SDF file; empty: none
  std::vector<std::string> model_paths;  // before those of the environment
  Pose robot_W;
  int samples = 4;
  bool shadows = true;
  bool collisions = false;  // draw collision bodies too
  int threads = 0;
  bool help = false;
};

/// Throws Error for an unknown or invalid argument.
RenderArguments parse_render_arguments(int argc, const char* const* argv);

std::string render_usage();

}  // namespace ardee
