// SPDX-License-Identifier: MIT
#pragma once

#include <visualization_msgs/Marker.h>

#include <vector>

#include "ardee_sim/core/pose.h"
#include "ardee_sim/description/geometry.h"

namespace ardee::node {

/// Appends the triangles of a heightmap within `radius_m` (on the ground plan) of any of the points
/// to a TRIANGLE_LIST, shaded by height and slope; `scale` is the placement's. A grid that is finer
/// than a picture needs is thinned.
void append_ground(const Heightmap& heightmap, const Pose& X_WV, double scale,
                   const std::vector<Eigen::Vector3d>& eyes_W, double radius_m,
                   visualization_msgs::Marker& marker);

}  // namespace ardee::node
