// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "ardee_sim/core/pose.h"

/// Limits of numbers, in SI units.
namespace ardee::limits {

/// Lengths, masses and the like above this are taken for mistakes.
constexpr double kAbsurd = 1e9;

// Parameters of sensors, drives and controllers; greater ones are taken for mistakes.
constexpr double kMostRate_hz = 1e6;       // the steps of physics take 1 us or more
constexpr double kLongestTime_s = 1e6;     // period, delay or time of correlation: 11 days
constexpr double kMostFactor = 1e6;        // of a noise, an exposure, a resolution, a coupling
constexpr double kMostTravel = 1e6;        // rad, m: position of a joint
constexpr double kFastestWheel = 1e6;      // m/s, rad/s
constexpr double kSmallestWheel_m = 1e-6;  // diameter of a wheel, distance of two; never zero

// Limits of a valid state. Code that writes a state checks it against them first; a body that
// leaves them in a step is put back. These limits apply to Euclidean norms, and are far below the
// values at which sums overflow.
constexpr double kFarthest_m = 1e6;  // of a link from the world's origin; a sensor's range
constexpr double kFastest = 1e9;     // m/s, rad/s
constexpr double kStrongest = 1e9;   // N, N m, applied to a body or a joint

/// Bounds the command of a wheel or an axle.
inline double wheel_command(double speed) {
  return std::clamp(speed, -kFastestWheel, kFastestWheel);
}

/// False for NaN, too.
inline bool is_within(const Eigen::Vector3d& vector, double most) { return vector.norm() <= most; }

inline bool is_valid(const Pose& X_WL) {
  return X_WL.is_finite() && is_within(X_WL.p, kFarthest_m);
}

inline bool is_valid(const Twist& twist_W) {
  return is_within(twist_W.linear, kFastest) && is_within(twist_W.angular, kFastest);
}

}  // namespace ardee::limits
