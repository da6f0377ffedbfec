// SPDX-License-Identifier: MIT
#pragma once

#include "ros/services.h"
#include "ros/tuning_server.h"

namespace ardee::node {

/// The world's physics by dynamic_reconfigure, with the names of gazebo_ros's Physics.cfg. A
/// request acts whole, or is refused and changes nothing.
class PhysicsTuning {
 public:
  /// `space` is the node's namespace; `context` outlives this object.
  PhysicsTuning(const std::string& space, ServiceContext& context);

  /// Publishes the numbers after another cause changed the physics.
  void publish() { server_.publish(); }

 private:
  devices::ParameterGroup describe(const std::string& space);
  devices::TunableParameter number(const char* name, const char* unit, double high, double initial,
                                   double PhysicsParams::*field);
  devices::TunableParameter count(const char* name, double initial, int PhysicsParams::*field);
  devices::TunableParameter gravity(const char* name, Eigen::Index axis, double initial);
  void set(const TuningServer::Values& values);

  ServiceContext& context_;
  ros::NodeHandle node_;
  PhysicsParams wanted_;  // of the present request
  const devices::ParameterGroup tuning_;
  TuningServer server_;
};

/// Warns once that requested numbers of Gazebo's have no effect.
void warn_of_inert_physics();

}  // namespace ardee::node
