// SPDX-License-Identifier: MIT
#pragma once

namespace ardee::devices {

/// Errors of a measured range: normal, with a standard deviation that grows with the range.
struct RangeNoise {
  double mean_m = 0.0;
  double std_m = 0.0;
  double growth = 0.0;       // deviation added, m per m of range
  double precision_m = 0.0;  // noisy ranges are multiples of it; 0: not quantised

  bool is_none() const {
    return mean_m == 0.0 && std_m <= 0.0 && growth <= 0.0 && precision_m <= 0.0;
  }
  /// Corrupts a finite range, before the device's limits apply; `normal` is a standard normal.
  double corrupt(double range_m, double normal) const;
};

}  // namespace ardee::devices
