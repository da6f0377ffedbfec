// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/model.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// A URDF <joint>: its kind of motion, and the pose of its child.
struct UrdfJoint {
  Joint joint;
  std::optional<Coupling> mimic;
  Pose X_PC;             // at zero, in the parent link's frame
  bool is_free = false;  // floating or planar: nothing holds the child, as in Gazebo
};

UrdfJoint read_urdf_joint(const Node& joint, Log& log);

}  // namespace ardee
