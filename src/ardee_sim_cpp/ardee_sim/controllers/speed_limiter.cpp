// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/speed_limiter.h"

#include <algorithm>

#include "ardee_sim/core/error.h"

namespace ardee::control {
namespace {

SpeedLimiter::Bounds read_bounds(const Setting& settings, const std::string& axis,
                                 const std::string& quantity) {
  SpeedLimiter::Bounds bounds;
  bounds.are_set = settings.boolean(axis + "/has_" + quantity + "_limits", false);
  bounds.high = settings.number(axis + "/max_" + quantity, 0.0);
  bounds.low = settings.number(axis + "/min_" + quantity, -bounds.high);
  if (bounds.are_set && !(bounds.low <= bounds.high)) {
    throw Error(settings.path() + "/" + axis + "/min_" + quantity + ": found " +
                std::to_string(bounds.low) + ", expected at most max_" + quantity + ", " +
                std::to_string(bounds.high));
  }
  return bounds;
}

}  // namespace

double SpeedLimiter::Bounds::clamp(double value) const {
  return are_set ? std::clamp(value, low, high) : value;
}

SpeedLimiter::SpeedLimiter(const Setting& settings, const std::string& axis)
    : velocity_(read_bounds(settings, axis, "velocity")),
      acceleration_(read_bounds(settings, axis, "acceleration")),
      jerk_(read_bounds(settings, axis, "jerk")) {}

double SpeedLimiter::limit(double wanted, double period_s) {
  double speed = wanted;
  if (jerk_.are_set) {
    const double change = last_ - before_last_;
    const double scale = 2.0 * period_s * period_s;
    const Bounds bounds{true, jerk_.low * scale, jerk_.high * scale};
    speed = last_ + change + bounds.clamp(speed - last_ - change);
  }
  if (acceleration_.are_set) {
    const Bounds bounds{true, acceleration_.low * period_s, acceleration_.high * period_s};
    speed = last_ + bounds.clamp(speed - last_);
  }
  speed = velocity_.clamp(speed);
  before_last_ = last_;
  last_ = speed;
  return speed;
}

}  // namespace ardee::control
