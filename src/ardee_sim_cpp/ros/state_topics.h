// SPDX-License-Identifier: MIT
#pragma once

#include <ros/publisher.h>

#include "ardee_sim/simulation/simulation.h"

namespace ardee::node {

/// model_states and link_states of Gazebo: names, poses and velocities in the world of all models
/// and of all their links, at each step, as long as there are subscribers. Plants that a field
/// model includes are part of that model and not listed, as in Gazebo.
class StateTopics {
 public:
  StateTopics(ros::NodeHandle& private_node, const Simulation& simulation);

  void publish();

 private:
  const Simulation& simulation_;
  ros::Publisher models_;
  ros::Publisher links_;
};

}  // namespace ardee::node
