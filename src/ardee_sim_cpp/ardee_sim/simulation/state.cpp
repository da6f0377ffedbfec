// SPDX-License-Identifier: MIT
// Poses and velocities of models and links, relative to one another: the part of Simulation that
// services ask for.
#include "ardee_sim/simulation/simulation.h"

namespace ardee {
namespace {

bool names_world(const std::string& name) {
  return name.empty() || name == "world" || name == "map";
}

}  // namespace

RelativeState Simulation::state_in_world(const std::string& name) const {
  if (names_world(name)) return {};
  const std::size_t colons = name.find("::");
  const std::string model_name = name.substr(0, colons);
  for (const auto& entity : entities_) {
    if (entity->name() != model_name) continue;
    const Robot& robot = *entity->robot;
    if (colons == std::string::npos) {
      const Pose X_WM = robot.pose();
      Twist twist_W;
      if (robot.is_dynamic()) {
        // The model's frame moves with its first link.
        const Pose X_WL = robot.link_pose(0);
        twist_W = robot.link_twist(0);
        twist_W.linear += twist_W.angular.cross(X_WM.p - X_WL.p);
      }
      return {X_WM, twist_W};
    }
    const std::size_t link = robot.link_index(name.substr(colons + 2), robot.model().source);
    return {robot.link_pose(link), robot.link_twist(link)};
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
  // Velocity as an observer who moves with the reference sees it.
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
  PhysicsModel& dynamics = entity->robot->dynamics();
  dynamics.set_pose(X_WM);
  Twist twist_W;
  twist_W.angular = frame.pose.q * state.twist.angular + frame.twist.angular;
  twist_W.linear = frame.pose.q * state.twist.linear + frame.twist.linear +
                   frame.twist.angular.cross(X_WM.p - frame.pose.p);
  dynamics.set_twist(twist_W);
  scenes_.invalidate();
}

}  // namespace ardee
