// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/readers/loader.h"
#include "ardee_sim/simulation/simulation.h"
#include "ros/message_tap.h"
#include "ros/robot_topics.h"
#include "ros/runner.h"
#include "ros/service_servers.h"

namespace ardee::node {

/// Context of the services. All references outlive them.
struct ServiceContext {
  Simulation& simulation;
  Loader& loader;
  RobotTopics& topics;
  Runner& runner;
  MessageTap& messages;
};

/// The services of Gazebo's node API and /ardee/step, one file per group.
void add_spawn_services(ServiceServers& servers, ServiceContext& context);
void add_control_services(ServiceServers& servers, ServiceContext& context);
void add_model_state_services(ServiceServers& servers, ServiceContext& context);
void add_link_state_services(ServiceServers& servers, ServiceContext& context);
void add_property_services(ServiceServers& servers, ServiceContext& context);
void add_set_property_services(ServiceServers& servers, ServiceContext& context);
void add_physics_services(ServiceServers& servers, ServiceContext& context);
void add_force_services(ServiceServers& servers, ServiceContext& context);
void add_light_services(ServiceServers& servers, ServiceContext& context);

/// Returns `value` if it lies between the two bounds. Throws Error naming the request's field
/// otherwise, and for NaN.
double checked(const std::string& field, double value, double low, double high);

/// The model of that name; throws Error if there is none.
Entity& require_model(ServiceContext& context, const std::string& name);

/// A link, found by "model::link" or by the name of a link that a model has.
struct LinkRef {
  Entity& entity;
  std::size_t link;
};
LinkRef require_link(ServiceContext& context, const std::string& name);

/// A joint, found by "model::joint" or by a joint's name that a moving model has.
struct JointRef {
  Entity& entity;
  std::size_t joint;
};
JointRef require_joint(ServiceContext& context, const std::string& name);

/// State in the world of a model, a model::link or the world (""). Throws Error for an unknown
/// name, naming the request's `field`.
RelativeState frame_in_world(ServiceContext& context, const std::string& reference,
                             const std::string& field);

}  // namespace ardee::node
