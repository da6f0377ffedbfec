// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/pose.h"
#include "ardee_sim/description/parameters.h"

namespace ardee::devices {

/// Where odometry comes from: the truth (the stock plugins' way) or the turns of the wheels.
enum class OdometrySource { kWorld, kEncoder };

/// <odometrySource>: world, encoder, or the stock plugins' numbers 1 and 0.
OdometrySource read_odometry_source(Parameters& parameters);

/// Dead reckoning of a vehicle with a left and a right side.
class WheelOdometry {
 public:
  /// The sides have rolled this far since the last call. The vehicle moves along the chord of the
  /// arc: Siegwart and Nourbakhsh, Introduction to Autonomous Mobile Robots, eq. 5.7.
  void roll(double left_m, double right_m, double separation_m);
  const Pose& pose() const { return pose_; }
  void reset() { pose_ = Pose{}; }

 private:
  Pose pose_;
};

}  // namespace ardee::devices
