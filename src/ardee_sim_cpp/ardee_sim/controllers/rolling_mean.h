// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <numeric>

#include "ardee_sim/core/state_archive.h"

namespace ardee::control {

/// The mean of the last values; of all values until the window is full.
class RollingMean {
 public:
  explicit RollingMean(std::size_t window) : window_(window) {}

  void add(double value) {
    values_.push_back(value);
    if (values_.size() > window_) values_.pop_front();
  }
  /// The mean; 0 without values.
  double mean() const {
    if (values_.empty()) return 0.0;
    return std::accumulate(values_.begin(), values_.end(), 0.0) /
           static_cast<double>(values_.size());
  }
  void clear() { values_.clear(); }
  void serialize(StateArchive& state) { state(values_); }

 private:
  std::size_t window_;
  std::deque<double> values_;
};

}  // namespace ardee::control
