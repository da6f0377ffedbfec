// SPDX-License-Identifier: MIT
#include "ardee_sim/simulation/joint_efforts.h"

#include <algorithm>

namespace ardee {
namespace {

template <typename Predicate>
void erase_if(std::vector<JointEffort>& efforts, Predicate predicate) {
  efforts.erase(std::remove_if(efforts.begin(), efforts.end(), predicate), efforts.end());
}

}  // namespace

void JointEfforts::clear(const devices::Robot& robot, std::size_t joint) {
  erase_if(efforts_,
           [&](const JointEffort& each) { return each.robot == &robot && each.joint == joint; });
}

void JointEfforts::clear(const devices::Robot& robot) {
  erase_if(efforts_, [&](const JointEffort& each) { return each.robot == &robot; });
}

void JointEfforts::apply(TimeNs now_ns) {
  erase_if(efforts_, [now_ns](const JointEffort& each) {
    return each.duration_ns >= 0 && now_ns >= each.start_ns + each.duration_ns;
  });
  for (const JointEffort& each : efforts_) {
    if (now_ns < each.start_ns) continue;
    each.robot->dynamics().apply_joint_effort(each.joint, each.effort);
  }
}

void JointEfforts::serialize(StateArchive& state,
                             const std::function<devices::Robot*(std::uint32_t)>& robot_of) {
  state.size_of(efforts_);
  for (JointEffort& each : efforts_) {
    std::uint32_t robot = each.robot != nullptr ? each.robot->entity() : 0;
    state(robot, each.joint, each.effort, each.start_ns, each.duration_ns);
    each.robot = robot_of(robot);
  }
}

}  // namespace ardee
