// SPDX-License-Identifier: MIT
// Poses and velocities of models, nested ones too, and of links, relative to one another: the part
// of Simulation that services ask for.
#include "ardee_sim/simulation/simulation.h"

namespace ardee {
namespace {

/// State of what stands at `X_CF` in a carrier.
RelativeState carried(const RelativeState& carrier_W, const Pose& X_CF) {
  RelativeState state{carrier_W.pose * X_CF, carrier_W.twist};
  const Eigen::Vector3d arm_W = state.pose.p - carrier_W.pose.p;
  state.twist.linear += state.twist.angular.cross(arm_W);
  return state;
}

RelativeState link_in_world(const devices::Robot& robot, std::size_t link) {
  return {robot.link_pose(link), robot.link_twist(link)};
}

}  // namespace

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

std::optional<NestedModel> Simulation::find_nested(const std::string& name) const {
  for (const auto& entity : entities_) {
    const std::string prefix = entity->name() + "::";
    if (name.compare(0, prefix.size(), prefix) != 0) continue;
    const auto frame = entity->robot->model().find_frame(name.substr(prefix.size()));
    if (frame && frame->is_model) return NestedModel{entity.get(), *frame};
  }
  return std::nullopt;
}

std::optional<Simulation::Named> Simulation::find_named(const std::string& name) const {
  for (const auto& entity : entities_) {
    const devices::Robot& robot = *entity->robot;
    if (entity->name() == name) return Named{entity.get(), {robot.pose(), robot.twist()}};
  }
  if (const auto found = find_link(name)) {
    return Named{found->entity, link_in_world(*found->entity->robot, found->link)};
  }
  const auto nested = find_nested(name);
  if (!nested) return std::nullopt;
  const devices::Robot& robot = *nested->entity->robot;
  const NamedFrame& frame = nested->frame;
  const Link* link = robot.model().find_link(frame.link);
  if (!link) return Named{nested->entity, carried({robot.pose(), robot.twist()}, frame.X_MF)};
  const auto number = static_cast<std::size_t>(link - robot.model().links.data());
  return Named{nested->entity,
               carried(link_in_world(robot, number), link->X_ML.inverse() * frame.X_MF)};
}

RelativeState Simulation::state_in_world(const std::string& name) const {
  if (names_world(name)) return {};
  if (const auto found = find_named(name)) return found->state_W;
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

void Simulation::set_state(const std::string& name, const RelativeState& state,
                           const std::string& reference) {
  const auto found = find_named(name);
  if (!found) throw Error("model '" + name + "' does not exist");
  if (!state.pose.is_finite() || !state.twist.linear.allFinite() ||
      !state.twist.angular.allFinite()) {
    throw Error("model '" + name + "': found a state that is not finite");
  }
  Entity& entity = *found->entity;
  const RelativeState frame = state_in_world(reference);
  RelativeState wanted_W{frame.pose * state.pose,
                         {frame.pose.q * state.twist.linear, frame.pose.q * state.twist.angular}};
  if (name != entity.name()) {
    wanted_W = carried(wanted_W, found->state_W.pose.inverse() * entity.robot->pose());
  }
  if (entity.is_static()) {
    place_static(entity, wanted_W.pose);
    return;
  }
  entity.robot->dynamics().set_state(wanted_W.pose, wanted_W.twist);
  for (const auto& device : entity.devices) device->on_set_state();
  scenes_.invalidate();
}

}  // namespace ardee
