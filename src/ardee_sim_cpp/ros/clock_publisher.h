// SPDX-License-Identifier: MIT
#pragma once

#include <ros/publisher.h>

#include <chrono>

#include "ardee_sim/core/time.h"

namespace ardee::node {

/// /clock: at most `rate_hz` messages a simulated second, and the exact time whenever stepping
/// ends. Who subscribes while the clock stands still gets the time at once.
class ClockPublisher {
 public:
  /// rate_hz 0: each step.
  explicit ClockPublisher(double rate_hz);

  /// After each step.
  void on_step(TimeNs now_ns);
  /// The time as it is, whatever the rate: when stepping ends, and again and again while paused, so
  /// that who comes then learns it.
  void publish(TimeNs now_ns);
  /// The clock was set back to `now_ns`.
  void restart(TimeNs now_ns);

 private:
  using Clock = std::chrono::steady_clock;

  ros::Publisher publisher_;
  RateTimer timer_;
  Clock::time_point earliest_ = Clock::now();
};

}  // namespace ardee::node
