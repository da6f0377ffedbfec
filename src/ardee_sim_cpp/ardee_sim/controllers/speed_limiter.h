// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/description/setting.h"

namespace ardee::control {

/// Limits a drive's command along one axis by bounds of speed, acceleration and jerk, each only if
/// set, from the two previous commands.
class SpeedLimiter {
 public:
  struct Bounds {
    bool are_set = false;
    double low = 0.0;
    double high = 0.0;

    double clamp(double value) const;
  };

  /// Reads "<axis>/has_velocity_limits", "max_velocity", "min_velocity" and so on; min_* are
  /// -max_* where not given.
  SpeedLimiter(const Setting& settings, const std::string& axis);

  /// The admissible next command nearest to the wanted one. The jerk is bounded first, then the
  /// acceleration, then the speed.
  double limit(double wanted, double period_s);
  /// Last result of limit().
  double last() const { return last_; }
  void reset() { last_ = before_last_ = 0.0; }
  void serialize(StateArchive& state) { state(last_, before_last_); }

 private:
  Bounds velocity_;
  Bounds acceleration_;
  Bounds jerk_;
  double last_ = 0.0;
  double before_last_ = 0.0;
};

}  // namespace ardee::control
