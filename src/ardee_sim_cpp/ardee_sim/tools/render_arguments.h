// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "ardee_sim/core/pose.h"

namespace ardee {

/// What render_world is told on its command line, in SI units.
struct RenderArguments {
  std::string world;
  std::string output;
  std::optional<Pose> camera_W;  // none: the world's own, or over all of it
  int width = 1280;
  int height = 720;
  double horizontal_fov_rad = 0.0;
  std::string robot;  // URDF or SDF file; empty: none
  Pose robot_W;
  int samples = 4;
  bool shadows = true;
  int threads = 0;
  bool help = false;
};

/// Throws Error for what is not understood.
RenderArguments parse_render_arguments(int argc, const char* const* argv);

std::string render_usage();

}  // namespace ardee
