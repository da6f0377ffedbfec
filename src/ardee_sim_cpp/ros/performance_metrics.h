// SPDX-License-Identifier: MIT
#pragma once

#include <gazebo_msgs/PerformanceMetrics.h>
#include <ros/node_handle.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

#include "ardee_sim/core/time.h"

namespace ardee::node {

/// Counts what sensors measure: how fast simulated time and each sensor go.
class PerformanceCounter {
 public:
  /// One moment by the clocks of the simulation and of the machine.
  struct Moment {
    TimeNs simulated_ns = 0;
    double wall_s = 0.0;
  };

  /// A sensor of several topics measures once at a time.
  void on_measured(const std::string& sensor, bool is_camera, const Moment& now);
  /// Of the time since the report before; a sensor's rates are those of its latest measurements.
  /// Who has been silent for a while is left out. The header is left to the caller.
  gazebo_msgs::PerformanceMetrics report(const Moment& now);

 private:
  struct Sensor {
    bool is_camera = false;
    std::uint64_t count = 0;  // of measurements after `from`, up to `last`
    Moment from;
    Moment last;
    double simulated_hz = 0.0;
    double wall_hz = 0.0;
  };
  Moment reported_;
  std::map<std::string, Sensor> sensors_;
};

/// performance_metrics of Gazebo 11, published while somebody listens.
class PerformanceMetrics {
 public:
  explicit PerformanceMetrics(ros::NodeHandle& private_node);

  /// Measurements need not be told otherwise.
  bool has_listeners() const { return publisher_.getNumSubscribers() > 0; }
  void on_measured(const std::string& sensor, bool is_camera, TimeNs now_ns);
  /// Called a few times a second of wall time.
  void publish(TimeNs now_ns);

 private:
  ros::Publisher publisher_;
  PerformanceCounter counter_;
};

}  // namespace ardee::node
