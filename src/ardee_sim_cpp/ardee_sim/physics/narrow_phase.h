// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ardee_sim/physics/collision_shape.h"

namespace ardee::physics {

/// A point where two shapes overlap. The normal points from the second shape into the first.
struct ContactPoint {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;
  double depth_m = 0.0;
  double share = 1.0;  // of the surfaces' stiffness
};

/// Finds at most `max_contacts` points where `a`, which moves, overlaps `b`.
void collide_shapes(const CollisionShape& a, const CollisionShape& b, int max_contacts,
                    std::vector<ContactPoint>& points);

}  // namespace ardee::physics
