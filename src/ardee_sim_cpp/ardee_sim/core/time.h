// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "ardee_sim/core/state_archive.h"

namespace ardee {

/// Simulated time in integer nanoseconds since the start of the simulation.
using TimeNs = std::int64_t;

constexpr double kNsPerSecond = 1e9;

inline double seconds(TimeNs time_ns) { return static_cast<double>(time_ns) / kNsPerSecond; }

/// Nearest whole nanosecond, clamped to the range of TimeNs (292 years).
TimeNs nanoseconds(double time_s);

/// Decides at which steps an event of a given rate is due. The k-th firing is at the first step at
/// or after k / rate, so a rate that does not divide the step keeps its exact mean and a rate that
/// does is exactly periodic.
class RateTimer {
 public:
  /// A rate_hz <= 0, or above one per nanosecond, is due at each step. `offset_ns` delays all
  /// firings.
  explicit RateTimer(double rate_hz = 0.0, TimeNs offset_ns = 0);

  /// True if a firing falls due at `now_ns`; missed firings (rate above the step's) are skipped,
  /// not repeated.
  bool due(TimeNs now_ns);
  /// Firings so far, missed ones counted: the index of the frame that due() has just announced is
  /// count() - 1.
  std::uint64_t count() const { return next_; }
  void reset() { next_ = 0; }
  void serialize(StateArchive& state) { state(next_); }
  /// Continues at `now_ns` as if it had run from time zero (a robot spawned later keeps the same
  /// grid of times). A timer that is due at each step continues its count from `now_ns` in
  /// nanoseconds, a number that no earlier firing has reached.
  void start_at(TimeNs now_ns);

 private:
  TimeNs firing_time(std::uint64_t index) const;

  double rate_hz_;
  TimeNs offset_ns_;
  std::uint64_t next_ = 0;
};

}  // namespace ardee
