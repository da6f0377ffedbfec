// SPDX-License-Identifier: MIT
#include <gazebo_msgs/DeleteModel.h>
#include <gazebo_msgs/SpawnModel.h>
#include <ros/names.h>

#include "ros/conversions.h"
#include "ros/services.h"

namespace ardee::node {
namespace {

/// Where a request puts the model, in the world.
Pose requested_pose(Stage& stage, const gazebo_msgs::SpawnModelRequest& request) {
  const Pose X_RM = from_ros(request.initial_pose);
  return frame_in_world(stage, request.reference_frame, "reference_frame").pose * X_RM;
}

/// The answer's first line is gazebo_ros's; what came to light follows, a line each.
std::string spawn(Stage& stage, const gazebo_msgs::SpawnModelRequest& request) {
  const MessageTap::Kept warnings(stage.messages);
  if (request.model_name.empty()) throw Error("found an empty model_name, expected a name");
  if (stage.simulation.find(request.model_name)) throw Error("Failure - entity already exists.");
  std::string why;
  if (!ros::names::validate(request.robot_namespace, why)) {
    throw Error("found robot_namespace '" + request.robot_namespace + "': " + why);
  }
  SpawnRequest wanted;
  wanted.name = request.model_name;
  wanted.robot_namespace = request.robot_namespace;
  wanted.model =
      stage.loader.load_model_text(request.model_xml, "model_xml of '" + request.model_name + "'");
  wanted.X_WM = requested_pose(stage, request);
  Entity& entity = stage.simulation.spawn(wanted);
  try {
    stage.topics.add(entity);
  } catch (...) {
    stage.simulation.remove(request.model_name);
    throw;
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
