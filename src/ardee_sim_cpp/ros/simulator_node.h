// SPDX-License-Identifier: MIT
#pragma once

#include <ros/node_handle.h>

#include "ardee_sim/readers/loader.h"
#include "ardee_sim/simulation/simulation.h"
#include "ros/arguments.h"
#include "ros/clock_publisher.h"
#include "ros/message_tap.h"
#include "ros/odometry_frames.h"
#include "ros/performance_metrics.h"
#include "ros/robot_topics.h"
#include "ros/runner.h"
#include "ros/scenery_markers.h"
#include "ros/services.h"
#include "ros/state_topics.h"

namespace ardee::node {

/// A simulation on a ROS network.
class SimulatorNode {
 public:
  /// Throws Error if the world cannot be loaded.
  SimulatorNode(const Settings& settings, ros::NodeHandle private_node);

  /// Runs until ROS shuts down.
  void run() { runner_.run(); }

 private:
  MessageTap messages_;
  Loader loader_;
  Simulation simulation_;
  OdometryFrames frames_;
  PerformanceMetrics metrics_;
  RobotTopics topics_;
  StateTopics states_;
  ClockPublisher clock_;
  SceneryMarkers scenery_;
  Runner runner_;
  ServiceContext context_;
  ServiceServers servers_;
};

/// Runs the node from start to end. Returns the process's exit code: 0, or 2 for a broken world or
/// setting.
int run_simulator(int argc, char** argv);

}  // namespace ardee::node
