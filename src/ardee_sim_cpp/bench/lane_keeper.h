// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "ardee_sim/core/pose.h"

namespace ardee::bench {

/// Drives to and fro on a straight line of a given length, by the true pose: forwards down the row,
/// backwards up again.
class LaneKeeper {
 public:
  /// Takes a line that starts at `start` and runs along its x axis.
  LaneKeeper(const Pose& start, double length_m, double speed_m_per_s)
      : start_(start), length_m_(length_m), speed_m_per_s_(speed_m_per_s) {}

  /// Returns forward speed and yaw rate in the robot's frame for a robot at X_WR.
  Twist command(const Pose& X_WR) {
    const Eigen::Vector3d p = start_.q.conjugate() * (X_WR.p - start_.p);
    const Eigen::Vector3d ahead = start_.q.conjugate() * (X_WR.q * Eigen::Vector3d::UnitX());
    if (p.x() > length_m_) direction_ = -1.0;
    if (p.x() < 0.0) direction_ = 1.0;
    const double yaw_rad = std::atan2(ahead.y(), ahead.x());
    const double turn =
        -kHeadingGain_per_s * yaw_rad - kOffsetGain_rad_per_m_s * direction_ * p.y();
    return {{direction_ * speed_m_per_s_, 0, 0},
            {0, 0, std::clamp(turn, -kMaxTurn_rad_per_s, kMaxTurn_rad_per_s)}};
  }

 private:
  static constexpr double kHeadingGain_per_s = 1.0;
  static constexpr double kOffsetGain_rad_per_m_s = 0.8;
  static constexpr double kMaxTurn_rad_per_s = 0.5;

  Pose start_;
  double length_m_;
  double speed_m_per_s_;
  double direction_ = 1.0;
};

}  // namespace ardee::bench
