// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/pose.h"

/// Limits of a valid state, in SI units. Code that writes a state checks it against them first; a
/// body that leaves them in a step is put back. All limits apply to Euclidean norms, and are far
/// below the values at which sums overflow.
namespace ardee::limits {

constexpr double kFarthest_m = 1e6;  // of a link from the world's origin
constexpr double kFastest = 1e9;     // m/s, rad/s
constexpr double kStrongest = 1e9;   // N, N m, applied to a body or a joint

/// False for NaN, too.
inline bool is_within(const Eigen::Vector3d& vector, double most) { return vector.norm() <= most; }

inline bool is_valid(const Pose& X_WL) {
  return X_WL.is_finite() && is_within(X_WL.p, kFarthest_m);
}

inline bool is_valid(const Twist& twist_W) {
  return is_within(twist_W.linear, kFastest) && is_within(twist_W.angular, kFastest);
}

}  // namespace ardee::limits
