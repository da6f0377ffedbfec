// SPDX-License-Identifier: MIT
#pragma once

#include <visualization_msgs/Marker.h>

#include <map>
#include <string>

#include "ardee_sim/core/pose.h"

namespace ardee::node {

/// Plants that are too far away for a mesh of their own, as coloured triangles in one marker: rviz
/// draws hundreds of plants at once, at the cost of a single mesh marker.
class FarPlants {
 public:
  /// Appends the coarse mesh file, placed and scaled, to a TRIANGLE_LIST in the world's frame. A
  /// file that cannot be read gives nothing.
  void append(const std::string& path, const Pose& X_WS, const Eigen::Vector3d& scale,
              visualization_msgs::Marker& marker);

 private:
  struct Triangles {
    std::vector<Eigen::Vector3d> corners;  // three a triangle
    std::vector<std_msgs::ColorRGBA> colors;
  };
  const Triangles& triangles_of(const std::string& path);

  std::map<std::string, Triangles> files_;
};

}  // namespace ardee::node
