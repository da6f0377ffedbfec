// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace ardee {

/// Pose in the world at which a robot's base_footprint starts: upright, before a lane of the field.
struct StartPose {
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.175;
  double yaw_rad = -3.14;
};

/// Reads <name>.start.yaml beside the world file <name>.world; none if there is no such file.
/// Throws Error for a file that holds anything but finite numbers x_m, y_m, z_m and yaw_rad.
std::optional<StartPose> read_start_pose(const std::string& world_file);

}  // namespace ardee
