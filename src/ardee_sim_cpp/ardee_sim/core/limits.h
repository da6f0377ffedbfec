// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/pose.h"

/// The contract of a valid state, in SI units. Whoever writes a state checks it against these
/// first; a body that leaves them in a step is put back. All are Euclidean norms, and far from
/// where sums overflow.
namespace ardee::limits {

constexpr double kFarthest_m =
    1e6;                            // of a link from the world's origin: beyond, it has been thrown
constexpr double kFastest = 1e9;    // m/s, rad/s
constexpr double kStrongest = 1e9;  // N, N m: what may be applied to a body or a joint

/// False for what is not a number, too.
inline bool is_within(const Eigen::Vector3d& vector, double most) { return vector.norm() <= most; }

inline bool is_valid(const Pose& X_WL) {
  return X_WL.is_finite() && is_within(X_WL.p, kFarthest_m);
}

inline bool is_valid(const Twist& twist_W) {
  return is_within(twist_W.linear, kFastest) && is_within(twist_W.angular, kFastest);
}

}  // namespace ardee::limits
