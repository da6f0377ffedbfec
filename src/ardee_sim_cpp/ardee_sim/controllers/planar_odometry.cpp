// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/planar_odometry.h"

#include <cmath>

namespace ardee::control {

void PlanarOdometry::start(TimeNs now_ns) {
  forward_.clear();
  left_.clear();
  turn_.clear();
  last_ns_ = now_ns;
}

void PlanarOdometry::reset(TimeNs now_ns) {
  start(now_ns);
  x_m_ = y_m_ = yaw_rad_ = 0.0;
  velocity_ = {};
}

void PlanarOdometry::move(const PlanarMotion& way) {
  constexpr double kStraight = 1e-6;  // rad: a shorter arc counts as its chord at the mean heading
  double along = 1.0;
  double across = 0.0;
  double heading = yaw_rad_;
  if (std::abs(way.turn) < kStraight) {
    heading += way.turn / 2.0;
  } else {
    along = std::sin(way.turn) / way.turn;
    across = (1.0 - std::cos(way.turn)) / way.turn;
  }
  const double forward = along * way.forward - across * way.left;
  const double left = across * way.forward + along * way.left;
  x_m_ += forward * std::cos(heading) - left * std::sin(heading);
  y_m_ += forward * std::sin(heading) + left * std::cos(heading);
  yaw_rad_ += way.turn;
}

void PlanarOdometry::add_way(const PlanarMotion& way, TimeNs now_ns) {
  constexpr TimeNs kShortestNs = 100'000;
  move(way);
  if (now_ns - last_ns_ < kShortestNs) return;
  const double elapsed_s = seconds(now_ns - last_ns_);
  last_ns_ = now_ns;
  forward_.add(way.forward / elapsed_s);
  left_.add(way.left / elapsed_s);
  turn_.add(way.turn / elapsed_s);
  velocity_ = {forward_.mean(), left_.mean(), turn_.mean()};
}

void PlanarOdometry::add_velocity(const PlanarMotion& velocity, TimeNs now_ns) {
  const double elapsed_s = seconds(now_ns - last_ns_);
  last_ns_ = now_ns;
  velocity_ = velocity;
  move({velocity.forward * elapsed_s, velocity.left * elapsed_s, velocity.turn * elapsed_s});
}

Pose PlanarOdometry::pose() const {
  return {{x_m_, y_m_, 0.0}, quaternion_from_rpy({0.0, 0.0, yaw_rad_})};
}

Twist PlanarOdometry::twist() const {
  return {{velocity_.forward, velocity_.left, 0.0}, {0.0, 0.0, velocity_.turn}};
}

}  // namespace ardee::control
