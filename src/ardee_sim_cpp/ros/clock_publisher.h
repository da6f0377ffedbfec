// SPDX-License-Identifier: MIT
#pragma once

#include <ros/publisher.h>

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
  /// The time as it is, whatever the rate: after a pause or the last of some steps.
  void publish(TimeNs now_ns);
  /// The clock was set back to `now_ns`.
  void restart(TimeNs now_ns);

 private:
  ros::Publisher publisher_;
  RateTimer timer_;
  TimeNs now_ns_ = 0;
};

}  // namespace ardee::node
