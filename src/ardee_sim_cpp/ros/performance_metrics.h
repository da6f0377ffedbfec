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

/// Counts measurements: the rates of simulated time and of each sensor.
class PerformanceCounter {
 public:
  /// One time by the clocks of the simulation and of the machine.
  struct Moment {
    TimeNs simulated_ns = 0;
    double wall_s = 0.0;
  };

  /// Counts a measurement. A sensor of several topics counts once per time.
  void on_measured(const std::string& sensor, bool is_camera, const Moment& now);
  /// Reports on the time since the previous report; a sensor's rates are those of its latest
  /// measurements. A sensor that has been silent for a while is left out. The caller fills in the
  /// header.
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

/// performance_metrics of Gazebo 11, published while it has subscribers.
class PerformanceMetrics {
 public:
  explicit PerformanceMetrics(ros::NodeHandle& private_node);

  /// Whether measurements need to be reported.
  bool has_listeners() const { return publisher_.getNumSubscribers() > 0; }
  void on_measured(const std::string& sensor, bool is_camera, TimeNs now_ns);
  /// Called a few times per second of wall time.
  void publish(TimeNs now_ns);

 private:
  ros::Publisher publisher_;
  PerformanceCounter counter_;
};

}  // namespace ardee::node
