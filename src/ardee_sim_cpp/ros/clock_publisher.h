// SPDX-License-Identifier: MIT
#pragma once

#include <ros/publisher.h>

#include <chrono>

#include "ardee_sim/core/time.h"

namespace ardee::node {

/// /clock: at most `rate_hz` messages per simulated second, and the exact time whenever stepping
/// ends. A subscriber that connects while the clock stands still gets the time at once.
class ClockPublisher {
 public:
  /// A `rate_hz` of 0 publishes at each step.
  explicit ClockPublisher(double rate_hz);

  /// Called after each step.
  void on_step(TimeNs now_ns);
  /// Publishes the present time at once, without regard to the rate: when stepping ends, and
  /// repeatedly while paused, for new subscribers.
  void publish(TimeNs now_ns);
  /// Called when the clock was set back to `now_ns`.
  void restart(TimeNs now_ns);

 private:
  using Clock = std::chrono::steady_clock;

  ros::Publisher publisher_;
  RateTimer timer_;
  Clock::time_point earliest_ = Clock::now();
};

}  // namespace ardee::node
