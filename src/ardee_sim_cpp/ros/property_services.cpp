// SPDX-License-Identifier: MIT
#include <gazebo_msgs/GetJointProperties.h>
#include <gazebo_msgs/GetLinkProperties.h>
#include <gazebo_msgs/GetModelProperties.h>
#include <gazebo_msgs/GetWorldProperties.h>

#include "ros/conversions.h"
#include "ros/services.h"

namespace ardee::node {
namespace {

std::string get_world(ServiceContext& context, gazebo_msgs::GetWorldPropertiesResponse& response) {
  response.sim_time = seconds(context.simulation.now_ns());
  for (const auto& entity : context.simulation.entities()) {
    response.model_names.push_back(entity->name());
  }
  response.rendering_enabled = true;  // always, as in gazebo_ros
  return "GetWorldProperties: got properties";
}

std::string get_model(ServiceContext& context, const std::string& name,
                      gazebo_msgs::GetModelPropertiesResponse& response) {
  const Entity& entity = require_model(context, name);
  const Model& model = entity.robot->model();
  response.canonical_body_name = model.canonical_link;
  for (const Link& link : model.links) {
    response.body_names.push_back(link.name);
    for (const Collision& collision : link.collisions) {
      response.geom_names.push_back(collision.name);
    }
  }
  for (const Joint& joint : model.joints) response.joint_names.push_back(joint.name);
  for (const Instance& child : model.instances) response.child_model_names.push_back(child.name);
  for (const NamedFrame& frame : model.frames) {
    const bool within_another = frame.name.find("::") != std::string::npos;
    if (frame.is_model && !within_another) response.child_model_names.push_back(frame.name);
  }
  response.is_static = entity.is_static();
  return "GetModelProperties: got properties";
}

std::string get_link(ServiceContext& context, const std::string& name,
                     gazebo_msgs::GetLinkPropertiesResponse& response) {
  const LinkRef ref = require_link(context, name);
  const devices::Robot& robot = *ref.entity.robot;
  const Link& described = robot.model().links[ref.link];
  const physics::LinkProperties link =
      robot.is_dynamic() ? robot.dynamics().link_properties(ref.link)
                         : physics::LinkProperties{described.inertial, described.gravity};
  response.gravity_mode = link.gravity;
  const Inertial inertial = link.inertial.value_or(Inertial{});
  response.com = to_ros(inertial.X_LI);
  response.mass = inertial.mass_kg;
  response.ixx = inertial.inertia_kg_m2(0, 0);
  response.ixy = inertial.inertia_kg_m2(0, 1);
  response.ixz = inertial.inertia_kg_m2(0, 2);
  response.iyy = inertial.inertia_kg_m2(1, 1);
  response.iyz = inertial.inertia_kg_m2(1, 2);
  response.izz = inertial.inertia_kg_m2(2, 2);
  return "GetLinkProperties: got properties";
}

std::uint8_t gazebo_type(JointType type) {
  using Response = gazebo_msgs::GetJointPropertiesResponse;
  switch (type) {
    case JointType::kRevolute:
    case JointType::kRevolute2:
      return Response::REVOLUTE;
    case JointType::kContinuous:
      return Response::CONTINUOUS;
    case JointType::kPrismatic:
    case JointType::kScrew:
      return Response::PRISMATIC;
    case JointType::kBall:
      return Response::BALL;
    case JointType::kUniversal:
      return Response::UNIVERSAL;
    case JointType::kFixed:
      break;
  }
  return Response::FIXED;
}

std::string get_joint(ServiceContext& context, const std::string& name,
                      gazebo_msgs::GetJointPropertiesResponse& response) {
  const JointRef ref = require_joint(context, name);
  const Joint& joint = ref.entity.robot->model().joints[ref.joint];
  response.type = gazebo_type(joint.type);
  const physics::PhysicsModel& dynamics = ref.entity.robot->dynamics();
  for (std::size_t axis = 0; axis < dynamics.joint_axes(ref.joint); ++axis) {
    response.damping.push_back(dynamics.joint_properties(ref.joint, axis).spring.damping);
  }
  if (joint.type != JointType::kFixed) {
    response.position = {dynamics.joint_position(ref.joint)};
    response.rate = {dynamics.joint_velocity(ref.joint)};
  }
  return "GetJointProperties: got properties";
}

}  // namespace

void add_property_services(ServiceServers& servers, ServiceContext& context) {
  servers.add<gazebo_msgs::GetWorldProperties>(
      "get_world_properties", "GetWorldProperties",
      [&context](const auto&, auto& response) { return get_world(context, response); });
  servers.add<gazebo_msgs::GetModelProperties>("get_model_properties", "GetModelProperties",
                                               [&context](const auto& request, auto& response) {
                                                 return get_model(context, request.model_name,
                                                                  response);
                                               });
  servers.add<gazebo_msgs::GetLinkProperties>(
      "get_link_properties", "GetLinkProperties", [&context](const auto& request, auto& response) {
        return get_link(context, request.link_name, response);
      });
  servers.add<gazebo_msgs::GetJointProperties>("get_joint_properties", "GetJointProperties",
                                               [&context](const auto& request, auto& response) {
                                                 return get_joint(context, request.joint_name,
                                                                  response);
                                               });
}

}  // namespace ardee::node
