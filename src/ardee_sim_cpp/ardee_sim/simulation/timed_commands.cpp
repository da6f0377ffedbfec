// SPDX-License-Identifier: MIT
#include "ardee_sim/simulation/timed_commands.h"

#include "ardee_sim/core/limits.h"

namespace ardee {

Wrench Wrench::accepted() const {
  using limits::is_within, limits::kStrongest;
  if (!is_within(force_W, kStrongest) || !is_within(torque_W, kStrongest) ||
      !is_within(point_L, limits::kFarthest_m)) {
    throw Error(
        "found a wrench with a number that is not finite or beyond 1e9 N, 1e9 N m or 1e6 m from "
        "the body, expected less");
  }
  // As in Gazebo, force and torque are computed once: the point does not turn with the body.
  const Pose X_WL = robot->link_pose(link);
  const auto& inertial = robot->dynamics().link_properties(link).inertial;
  const Eigen::Vector3d center_L = inertial ? inertial->X_LI.p : Eigen::Vector3d(0, 0, 0);
  Wrench fixed = *this;
  fixed.torque_W += (X_WL.q * (point_L - center_L)).cross(force_W);
  fixed.point_L = center_L;
  if (!is_within(fixed.torque_W, kStrongest)) {
    throw Error("found a wrench whose torque about the centre of mass is beyond 1e9 N m");
  }
  return fixed;
}

void Wrench::apply() const {
  robot->dynamics().apply_wrench(link, force_W, robot->link_pose(link) * point_L, torque_W);
}

}  // namespace ardee
