// SPDX-License-Identifier: MIT
#include <gazebo_msgs/DeleteModel.h>
#include <gazebo_msgs/SpawnModel.h>
#include <ros/names.h>

#include "ros/conversions.h"
#include "ros/services.h"

namespace ardee::node {
namespace {

/// The first words are Gazebo's.
Error already_exists(const std::string& kind, const std::string& name) {
  return Error(
      "Failure - entity already exists: there is a " + kind + " named '" + name +
      "'; delete it (rosservice call /gazebo/delete_" + kind + " " + name +
      "), or choose another name (spawn_model -model NAME, launch files model_name:=NAME)");
}

/// Pose of a request's model in the world.
Pose requested_pose(ServiceContext& context, const gazebo_msgs::SpawnModelRequest& request) {
  const Pose X_RM = from_ros(request.initial_pose);
  return frame_in_world(context, request.reference_frame, "reference_frame").pose * X_RM;
}

void spawn_light(ServiceContext& context, const gazebo_msgs::SpawnModelRequest& request,
                 Light light) {
  light.name = request.model_name;
  light.pose = requested_pose(context, request) * light.pose;
  for (const Light& other : context.simulation.lights()) {
    if (other.name == light.name) throw already_exists("light", light.name);
  }
  context.simulation.add_light(light);
}

void spawn_model(ServiceContext& context, const gazebo_msgs::SpawnModelRequest& request,
                 std::shared_ptr<const Model> model) {
  SpawnRequest wanted;
  wanted.name = request.model_name;
  wanted.robot_namespace = request.robot_namespace;
  wanted.model = std::move(model);
  wanted.X_WM = requested_pose(context, request);
  Entity& entity = context.simulation.spawn(wanted);
  try {
    context.topics.add(entity);
  } catch (...) {
    context.simulation.remove(request.model_name);
    throw;
  }
}

/// The answer's first line is gazebo_ros's; warnings and errors follow, one per line.
std::string spawn(ServiceContext& context, const gazebo_msgs::SpawnModelRequest& request) {
  const MessageTap::Kept warnings(context.messages);
  if (request.model_name.empty()) throw Error("found an empty model_name, expected a name");
  if (context.simulation.find(request.model_name)) {
    throw already_exists("model", request.model_name);
  }
  std::string why;
  if (!ros::names::validate(request.robot_namespace, why)) {
    throw Error("found robot_namespace '" + request.robot_namespace + "': " + why);
  }
  const auto described = context.loader.load_model_or_light_text(
      request.model_xml, "model_xml of '" + request.model_name + "'");
  if (const auto* light = std::get_if<Light>(&described)) {
    spawn_light(context, request, *light);
  } else {
    spawn_model(context, request, std::get<std::shared_ptr<const Model>>(described));
  }
  std::string message = "SpawnModel: Successfully spawned entity";
  for (const std::string& text : warnings.texts()) message += "\n" + text;
  return message;
}

std::string remove(ServiceContext& context, const std::string& name) {
  require_model(context, name);
  context.topics.remove(name);
  context.simulation.remove(name);
  return "DeleteModel: successfully deleted model";
}

}  // namespace

void add_spawn_services(ServiceServers& servers, ServiceContext& context) {
  for (const char* name : {"spawn_urdf_model", "spawn_sdf_model"}) {
    servers.add<gazebo_msgs::SpawnModel>(
        name, "SpawnModel",
        [&context](const auto& request, auto&) { return spawn(context, request); });
  }
  servers.add<gazebo_msgs::DeleteModel>(
      "delete_model", "DeleteModel",
      [&context](const auto& request, auto&) { return remove(context, request.model_name); });
}

}  // namespace ardee::node
