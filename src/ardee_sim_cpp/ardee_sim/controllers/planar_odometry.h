// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/controllers/rolling_mean.h"
#include "ardee_sim/core/pose.h"
#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/core/time.h"

namespace ardee::control {

/// A motion in the plane, in the axes of the moving body: a displacement in m and rad, or a
/// velocity in m/s and rad/s.
struct PlanarMotion {
  double forward = 0.0;
  double left = 0.0;
  double turn = 0.0;
};

/// Dead reckoning: the pose of a vehicle on a plane, from its reported motions.
class PlanarOdometry {
 public:
  /// `window` is the number of velocities in the mean.
  explicit PlanarOdometry(std::size_t window) : forward_(window), left_(window), turn_(window) {}

  /// Restarts at the present pose.
  void start(TimeNs now_ns);
  void reset(TimeNs now_ns);
  void serialize(StateArchive& state) {
    state(x_m_, y_m_, yaw_rad_, velocity_, forward_, left_, turn_, last_ns_);
  }
  /// Adds a displacement since the last call, along an arc. The velocity becomes the mean of
  /// displacement over time, for intervals of 0.1 ms and more.
  void add_way(const PlanarMotion& way, TimeNs now_ns);
  /// Adds a motion at constant velocity since the last call.
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
