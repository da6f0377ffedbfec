// SPDX-License-Identifier: MIT
#pragma once

#include <ros/node_handle.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/core/log.h"
#include "ardee_sim/simulation/entity.h"
#include "ros/controller_services.h"
#include "ros/odometry_frames.h"
#include "ros/performance_metrics.h"
#include "ros/port_topics.h"

namespace ardee::node {

/// The topics and services of the robots' devices: publishers of their readings, subscribers to
/// their commands. They exist from the spawn of a robot to its removal.
class RobotTopics : public devices::ReadingSink {
 public:
  RobotTopics(OdometryFrames& frames, PerformanceMetrics& metrics, Log log)
      : frames_(frames), metrics_(metrics), log_(std::move(log)) {}

  /// Creates the topics of an entity. A sensor whose topics cannot be created is removed from the
  /// entity, with a message. Throws Error if those of another device cannot, and leaves no topic of
  /// the entity.
  void add(Entity& entity);
  void remove(const std::string& entity_name);
  /// Tells the devices which of their outputs have subscribers.
  void update_demand();
  void on_reading(const devices::Output& output, const devices::Reading& reading) override;

 private:
  struct Topics {
    std::vector<std::unique_ptr<PortTopics>> devices;
    std::vector<std::unique_ptr<ControllerServices>> managers;
    std::vector<std::string> taken;  // services
  };
  void add(devices::Device& device, const devices::Robot& robot, Topics& topics);
  void count(const Route& route, TimeNs now_ns);

  OdometryFrames& frames_;
  PerformanceMetrics& metrics_;
  Log log_;
  ros::NodeHandle node_;
  Routes routes_;
  std::map<std::string, Topics> topics_;
};

}  // namespace ardee::node
