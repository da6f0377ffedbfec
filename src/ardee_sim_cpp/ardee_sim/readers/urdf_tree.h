// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ardee_sim/readers/urdf_joint.h"

namespace ardee {

/// Tree of a robot's links.
struct UrdfTree {
  std::vector<std::size_t> order;  // indices of the links, parents before children
  std::vector<Pose> X_ML;          // of each link in the root link's frame, with all joints at zero
};

/// Throws Error unless links and joints make one tree: names that are unique, ends that exist, one
/// root, every other link the child of one joint and reached from the root. Takes time in
/// proportion to their number.
UrdfTree make_urdf_tree(const Node& robot, const std::vector<Link>& links,
                        const std::vector<UrdfJoint>& joints);

}  // namespace ardee
