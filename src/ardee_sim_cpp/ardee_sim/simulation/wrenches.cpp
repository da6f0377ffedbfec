// SPDX-License-Identifier: MIT
#include "ardee_sim/simulation/wrenches.h"

#include <algorithm>

#include "ardee_sim/core/limits.h"

namespace ardee {
namespace {

template <typename Predicate>
void erase_if(std::vector<Wrench>& wrenches, Predicate predicate) {
  wrenches.erase(std::remove_if(wrenches.begin(), wrenches.end(), predicate), wrenches.end());
}

}  // namespace

void Wrenches::add(const Wrench& wrench) {
  using limits::is_within, limits::kStrongest;
  if (!is_within(wrench.force_W, kStrongest) || !is_within(wrench.torque_W, kStrongest) ||
      !is_within(wrench.point_L, limits::kFarthest_m)) {
    throw Error(
        "found a wrench with a number that is not finite or beyond 1e9 N, 1e9 N m or 1e6 m from "
        "the body, expected less");
  }
  // As in Gazebo, force and torque are computed once: the point does not turn with the body.
  const Pose X_WL = wrench.robot->link_pose(wrench.link);
  const auto& inertial = wrench.robot->dynamics().link_properties(wrench.link).inertial;
  const Eigen::Vector3d center_L = inertial ? inertial->X_LI.p : Eigen::Vector3d(0, 0, 0);
  Wrench fixed = wrench;
  fixed.torque_W += (X_WL.q * (wrench.point_L - center_L)).cross(wrench.force_W);
  fixed.point_L = center_L;
  if (!is_within(fixed.torque_W, kStrongest)) {
    throw Error("found a wrench whose torque about the centre of mass is beyond 1e9 N m");
  }
  wrenches_.push_back(fixed);
}

void Wrenches::clear(const devices::Robot& robot, std::size_t link) {
  erase_if(wrenches_,
           [&](const Wrench& wrench) { return wrench.robot == &robot && wrench.link == link; });
}

void Wrenches::clear(const devices::Robot& robot) {
  erase_if(wrenches_, [&](const Wrench& wrench) { return wrench.robot == &robot; });
}

void Wrenches::apply(TimeNs now_ns) {
  erase_if(wrenches_, [now_ns](const Wrench& wrench) {
    return wrench.duration_ns >= 0 && now_ns >= wrench.start_ns + wrench.duration_ns;
  });
  for (const Wrench& wrench : wrenches_) {
    if (now_ns < wrench.start_ns) continue;
    const Pose X_WL = wrench.robot->link_pose(wrench.link);
    wrench.robot->dynamics().apply_wrench(wrench.link, wrench.force_W, X_WL * wrench.point_L,
                                          wrench.torque_W);
  }
}

void Wrenches::serialize(StateArchive& state,
                         const std::function<devices::Robot*(std::uint32_t)>& robot_of) {
  state.size_of(wrenches_);
  for (Wrench& each : wrenches_) {
    std::uint32_t robot = each.robot != nullptr ? each.robot->entity() : 0;
    state(robot, each.link, each.force_W, each.torque_W, each.point_L, each.start_ns,
          each.duration_ns);
    each.robot = robot_of(robot);
  }
}

}  // namespace ardee
