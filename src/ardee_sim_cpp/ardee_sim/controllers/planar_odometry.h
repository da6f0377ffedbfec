// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/controllers/rolling_mean.h"
#include "ardee_sim/core/pose.h"
#include "ardee_sim/core/time.h"

namespace ardee::control {

/// A motion in the plane, in the axes of what moves: a way in m and rad, or a velocity in m/s and
/// rad/s.
struct PlanarMotion {
  double forward = 0.0;
  double left = 0.0;
  double turn = 0.0;
};

/// Where a vehicle has come to on a plane, from how it says to have moved.
class PlanarOdometry {
 public:
  /// `window`: how many velocities the mean is taken over.
  explicit PlanarOdometry(std::size_t window) : forward_(window), left_(window), turn_(window) {}

  /// Begins again from the pose that it has.
  void start(TimeNs now_ns);
  void reset(TimeNs now_ns);
  /// The vehicle has moved by that way since the last time, on an arc. The velocity becomes the
  /// mean of way over time, of times of 0.1 ms and more.
  void add_way(const PlanarMotion& way, TimeNs now_ns);
  /// The vehicle has moved at that velocity since the last time.
  void add_velocity(const PlanarMotion& velocity, TimeNs now_ns);

  Pose pose() const;
  Twist twist() const;

 private:
  void move(const PlanarMotion& way);

  double x_m_ = 0.0;
  double y_m_ = 0.0;
  double yaw_rad_ = 0.0;
  PlanarMotion velocity_;
  RollingMean forward_;
  RollingMean left_;
  RollingMean turn_;
  TimeNs last_ns_ = 0;
};

}  // namespace ardee::control
