// SPDX-License-Identifier: MIT
#include <gazebo_msgs/GetModelState.h>
#include <gazebo_msgs/SetModelConfiguration.h>
#include <gazebo_msgs/SetModelState.h>

#include "ardee_sim/core/limits.h"
#include "ros/conversions.h"
#include "ros/services.h"

namespace ardee::node {
namespace {

void require_model_or_nested(ServiceContext& context, const std::string& name) {
  if (!context.simulation.find_nested(name)) require_model(context, name);
}

std::string get_state(ServiceContext& context, const gazebo_msgs::GetModelStateRequest& request,
                      gazebo_msgs::GetModelStateResponse& response) {
  require_model_or_nested(context, request.model_name);
  frame_in_world(context, request.relative_entity_name, "relative_entity_name");
  const RelativeState state =
      context.simulation.state(request.model_name, request.relative_entity_name);
  response.header.stamp = to_ros(context.simulation.now_ns());
  response.header.frame_id = request.relative_entity_name;
  response.pose = to_ros(state.pose);
  response.twist = to_ros(state.twist);
  return "GetModelState: got properties";
}

void set_state(ServiceContext& context, const gazebo_msgs::ModelState& wanted) {
  require_model_or_nested(context, wanted.model_name);
  frame_in_world(context, wanted.reference_frame, "reference_frame");
  const RelativeState state{from_ros(wanted.pose), from_ros(wanted.twist)};
  if (!is_finite(state.twist)) throw Error("found a twist that is not finite");
  context.simulation.set_state(wanted.model_name, state, wanted.reference_frame);
}

/// Moves all joints or none: a fault that only the motion reveals (a closed chain, a link out of
/// the world) puts the moved joints back.
void move_joints(physics::PhysicsModel& dynamics, const std::vector<std::size_t>& joints,
                 const std::vector<double>& positions) {
  std::vector<double> before;
  try {
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const double now = dynamics.joint_position(joints[i]);
      dynamics.set_joint_position(joints[i], positions[i]);
      before.push_back(now);
    }
  } catch (...) {
    for (std::size_t i = before.size(); i > 0; --i) {
      dynamics.set_joint_position(joints[i - 1], before[i - 1]);
    }
    throw;
  }
}

/// Finds all joints and checks all numbers before the first joint moves.
std::string set_joints(ServiceContext& context,
                       const gazebo_msgs::SetModelConfigurationRequest& request) {
  const Entity& entity = require_model(context, request.model_name);
  if (request.joint_names.size() != request.joint_positions.size()) {
    throw Error("found " + std::to_string(request.joint_names.size()) + " joint_names and " +
                std::to_string(request.joint_positions.size()) +
                " joint_positions, expected one position a name");
  }
  std::vector<std::size_t> joints;
  for (std::size_t i = 0; i < request.joint_names.size(); ++i) {
    const JointRef ref = require_joint(context, entity.name() + "::" + request.joint_names[i]);
    if (entity.robot->dynamics().joint_axes(ref.joint) == 0) {
      throw Error("joint '" + request.joint_names[i] +
                  "' has no axis, expected one that moves along one");
    }
    checked("joint '" + request.joint_names[i] + "'", request.joint_positions[i],
            -limits::kMostTravel, limits::kMostTravel);
    joints.push_back(ref.joint);
  }
  move_joints(entity.robot->dynamics(), joints, request.joint_positions);
  return "SetModelConfiguration: success";
}

}  // namespace

void add_model_state_services(ServiceServers& servers, ServiceContext& context) {
  servers.add<gazebo_msgs::GetModelState>("get_model_state", "GetModelState",
                                          [&context](const auto& request, auto& response) {
                                            return get_state(context, request, response);
                                          });
  servers.add<gazebo_msgs::SetModelState>("set_model_state", "SetModelState",
                                          [&context](const auto& request, auto&) {
                                            set_state(context, request.model_state);
                                            return "SetModelState: set model state done";
                                          });
  servers.add<gazebo_msgs::SetModelConfiguration>(
      "set_model_configuration", "SetModelConfiguration",
      [&context](const auto& request, auto&) { return set_joints(context, request); });
  servers.listen<gazebo_msgs::ModelState>(
      "set_model_state", "SetModelState",
      [&context](const auto& wanted) { set_state(context, wanted); });
}

}  // namespace ardee::node
