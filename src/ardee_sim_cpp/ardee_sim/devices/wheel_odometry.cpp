// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/wheel_odometry.h"

#include <cmath>

namespace ardee::devices {
namespace {

template <typename Wheels, typename Value>
double mean(Wheels& wheels, const Value& value) {
  double sum = value(wheels.front());
  for (std::size_t i = 1; i < wheels.size(); ++i) sum += value(wheels[i]);
  return sum / static_cast<double>(wheels.size());
}

}  // namespace

WheelOdometry::WheelOdometry(const Params& params, const Robot& robot)
    : robot_(robot),
      wheel_radius_m_(params.wheel_diameter_m / 2.0),
      wheel_separation_m_(params.wheel_separation_m) {
  for (const std::size_t joint : params.left_joints) left_.push_back({joint});
  for (const std::size_t joint : params.right_joints) right_.push_back({joint});
  reset();
}

double WheelOdometry::rolled_m(Side& side) const {
  return wheel_radius_m_ * mean(side, [this](Wheel& wheel) {
           const double before_rad = wheel.angle_rad;
           wheel.angle_rad = robot_.dynamics().joint_position(wheel.joint);
           return wheel.angle_rad - before_rad;
         });
}

double WheelOdometry::speed_m_per_s(const Side& side) const {
  return wheel_radius_m_ * mean(side, [this](const Wheel& wheel) {
           return robot_.dynamics().joint_velocity(wheel.joint);
         });
}

void WheelOdometry::update() {
  const double left_m = rolled_m(left_);
  const double right_m = rolled_m(right_);
  const double turn = (right_m - left_m) / wheel_separation_m_;
  const double yaw = rpy_from_quaternion(pose_.q).z();
  const double heading = yaw + turn / 2.0;
  pose_.p += 0.5 * (left_m + right_m) * Eigen::Vector3d(std::cos(heading), std::sin(heading), 0.0);
  pose_.q = quaternion_from_rpy({0.0, 0.0, yaw + turn});
}

Twist WheelOdometry::twist() const {
  const double left = speed_m_per_s(left_);
  const double right = speed_m_per_s(right_);
  return {{0.5 * (left + right), 0.0, 0.0}, {0.0, 0.0, (right - left) / wheel_separation_m_}};
}

void WheelOdometry::reset() {
  pose_ = Pose{};
  rolled_m(left_);
  rolled_m(right_);
}

}  // namespace ardee::devices
