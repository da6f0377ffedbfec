// SPDX-License-Identifier: MIT
#include "ros/joint_efforts.h"

#include <algorithm>

namespace ardee::node {
namespace {

template <typename Predicate>
void erase_if(std::vector<JointEffort>& efforts, Predicate predicate) {
  efforts.erase(std::remove_if(efforts.begin(), efforts.end(), predicate), efforts.end());
}

}  // namespace

void JointEfforts::clear(const std::string& model, std::size_t joint) {
  erase_if(efforts_, [&](const auto& each) { return each.model == model && each.joint == joint; });
}

void JointEfforts::clear_model(const std::string& model) {
  erase_if(efforts_, [&](const auto& each) { return each.model == model; });
}

void JointEfforts::apply(Simulation& simulation) {
  const TimeNs now_ns = simulation.now_ns();
  erase_if(efforts_, [now_ns](const auto& each) {
    return each.duration_ns >= 0 && now_ns >= each.start_ns + each.duration_ns;
  });
  for (const JointEffort& each : efforts_) {
    Entity* entity = simulation.find(each.model);
    if (entity && now_ns >= each.start_ns) {
      entity->robot->dynamics().apply_joint_effort(each.joint, each.effort);
    }
  }
}

}  // namespace ardee::node
