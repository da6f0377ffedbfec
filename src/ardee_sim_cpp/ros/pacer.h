// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

#include "ardee_sim/core/time.h"

namespace ardee::node {

/// Keeps simulated time at a multiple of wall time. The schedule is counted from one anchor, so
/// that it does not drift; a simulation that falls far behind starts a new schedule instead of
/// racing to catch up.
class Pacer {
 public:
  /// Simulated seconds per second of wall time; 0: as fast as the machine can.
  void set_factor(double factor, TimeNs now_ns);
  double factor() const { return factor_; }
  /// Starts a new schedule, after a pause or a reset.
  void restart(TimeNs now_ns);
  /// Wall time in seconds until the simulation may go beyond `now_ns`; not positive: at once.
  double wait_s(TimeNs now_ns);

 private:
  using Clock = std::chrono::steady_clock;

  double factor_ = 0.0;
  TimeNs anchor_ns_ = 0;
  Clock::time_point anchor_ = Clock::now();
};

}  // namespace ardee::node
