// SPDX-License-Identifier: MIT
// Poses and velocities of models and links, relative to one another: the part of Simulation that
// services ask for.
#include "ardee_sim/simulation/simulation.h"

namespace ardee {

bool names_world(const std::string& name) {
  return name.empty() || name == "world" || name == "map" || name == "/map";
}

std::optional<LinkOf> Simulation::find_link(const std::string& name) const {
  std::optional<LinkOf> unscoped;
  for (const auto& entity : entities_) {
    const std::string prefix = entity->name() + "::";
    const bool has_prefix = name.compare(0, prefix.size(), prefix) == 0;
    const std::string rest = has_prefix ? name.substr(prefix.size()) : "";
    const auto& links = entity->robot->model().links;
    for (std::size_t link = 0; link < links.size(); ++link) {
      if (has_prefix && links[link].name == rest) return LinkOf{entity.get(), link};
      if (!unscoped && links[link].name == name) unscoped = LinkOf{entity.get(), link};
    }
  }
  return unscoped;
}

RelativeState Simulation::state_in_world(const std::string& name) const {
  if (names_world(name)) return {};
  for (const auto& entity : entities_) {
    if (entity->name() == name) return {entity->robot->pose(), entity->robot->twist()};
  }
  if (const auto found = find_link(name)) {
    const devices::Robot& robot = *found->entity->robot;
    return {robot.link_pose(found->link), robot.link_twist(found->link)};
  }
  throw Error("'" + name + "' does not exist, expected a model, model::link or world");
}

RelativeState Simulation::state(const std::string& name, const std::string& reference) const {
  const RelativeState body = state_in_world(name);
  const RelativeState frame = state_in_world(reference);
  const Eigen::Quaterniond q_FW = frame.pose.q.conjugate();
  const Eigen::Vector3d arm_W = body.pose.p - frame.pose.p;
  RelativeState relative;
  relative.pose = frame.pose.inverse() * body.pose;
  // Velocity seen by an observer that moves with the reference.
  relative.twist.linear =
      q_FW * (body.twist.linear - frame.twist.linear - frame.twist.angular.cross(arm_W));
  relative.twist.angular = q_FW * (body.twist.angular - frame.twist.angular);
  return relative;
}

void Simulation::set_state(const std::string& model, const RelativeState& state,
                           const std::string& reference) {
  Entity* entity = find(model);
  if (!entity) throw Error("model '" + model + "' does not exist");
  if (!state.pose.is_finite() || !state.twist.linear.allFinite() ||
      !state.twist.angular.allFinite()) {
    throw Error("model '" + model + "': found a state that is not finite");
  }
  const RelativeState frame = state_in_world(reference);
  const Pose X_WM = frame.pose * state.pose;
  if (entity->is_static()) {
    place_static(*entity, X_WM);
    return;
  }
  const Twist twist_W{frame.pose.q * state.twist.linear, frame.pose.q * state.twist.angular};
  entity->robot->dynamics().set_state(X_WM, twist_W);
  for (const auto& device : entity->devices) device->on_set_state();
  scenes_.invalidate();
}

}  // namespace ardee
