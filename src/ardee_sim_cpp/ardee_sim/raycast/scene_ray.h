// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace ardee::raycast {

/// Ray with its own origin.
struct SceneRay {
  Eigen::Vector3d origin_W{0, 0, 0};
  Eigen::Vector3d direction_W{1, 0, 0};  // unit
  double reach_m = std::numeric_limits<double>::infinity();
};

/// Unit directions in the sensor's frame, all from its origin: a lidar's, sonar's or camera's
/// pattern as data.
struct RayPattern {
  std::vector<Eigen::Vector3f> directions_S;
};

}  // namespace ardee::raycast
