// SPDX-License-Identifier: MIT
#include <gazebo_msgs/DeleteModel.h>
#include <gazebo_msgs/SpawnModel.h>
#include <ros/names.h>

#include "ros/conversions.h"
#include "ros/services.h"

namespace ardee::node {
namespace {

Error already_exists() { return Error("Failure - entity already exists."); }

/// Where a request puts the model, in the world.
Pose requested_pose(Stage& stage, const gazebo_msgs::SpawnModelRequest& request) {
  const Pose X_RM = from_ros(request.initial_pose);
  return frame_in_world(stage, request.reference_frame, "reference_frame").pose * X_RM;
}

void spawn_light(Stage& stage, const gazebo_msgs::SpawnModelRequest& request, Light light) {
  light.name = request.model_name;
  light.pose = requested_pose(stage, request) * light.pose;
  for (const Light& other : stage.simulation.world().lights) {
    if (other.name == light.name) throw already_exists();
  }
  stage.simulation.add_light(light);
}

void spawn_model(Stage& stage, const gazebo_msgs::SpawnModelRequest& request,
                 std::shared_ptr<const Model> model) {
  SpawnRequest wanted;
  wanted.name = request.model_name;
  wanted.robot_namespace = request.robot_namespace;
  wanted.model = std::move(model);
  wanted.X_WM = requested_pose(stage, request);
  Entity& entity = stage.simulation.spawn(wanted);
  try {
    stage.topics.add(entity);
  } catch (...) {
    stage.simulation.remove(request.model_name);
    throw;
  }
}

/// The answer's first line is gazebo_ros's; what came to light follows, a line each.
std::string spawn(Stage& stage, const gazebo_msgs::SpawnModelRequest& request) {
  const MessageTap::Kept warnings(stage.messages);
  if (request.model_name.empty()) throw Error("found an empty model_name, expected a name");
  if (stage.simulation.find(request.model_name)) throw already_exists();
  std::string why;
  if (!ros::names::validate(request.robot_namespace, why)) {
    throw Error("found robot_namespace '" + request.robot_namespace + "': " + why);
  }
  const auto described = stage.loader.load_model_or_light_text(
      request.model_xml, "model_xml of '" + request.model_name + "'");
  if (const auto* light = std::get_if<Light>(&described)) {
    spawn_light(stage, request, *light);
  } else {
    spawn_model(stage, request, std::get<std::shared_ptr<const Model>>(described));
  }
  std::string message = "SpawnModel: Successfully spawned entity";
  for (const std::string& text : warnings.texts()) message += "\n" + text;
  return message;
}

std::string remove(Stage& stage, const std::string& name) {
  require_model(stage, name);
  stage.topics.remove(name);
  stage.simulation.remove(name);
  return "DeleteModel: successfully deleted model";
}

}  // namespace

void add_spawn_services(ServiceServers& servers, Stage& stage) {
  for (const char* name : {"spawn_urdf_model", "spawn_sdf_model"}) {
    servers.add<gazebo_msgs::SpawnModel>(
        name, "SpawnModel", [&stage](const auto& request, auto&) { return spawn(stage, request); });
  }
  servers.add<gazebo_msgs::DeleteModel>(
      "delete_model", "DeleteModel",
      [&stage](const auto& request, auto&) { return remove(stage, request.model_name); });
}

}  // namespace ardee::node
