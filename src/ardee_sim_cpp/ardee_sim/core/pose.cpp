// SPDX-License-Identifier: MIT
#include "ardee_sim/core/pose.h"

#include <algorithm>
#include <cmath>

namespace ardee {

Pose Pose::from_xyz_rpy(const Eigen::Vector3d& xyz, const Eigen::Vector3d& rpy) {
  return {xyz, quaternion_from_rpy(rpy)};
}

Pose Pose::inverse() const {
  const Eigen::Quaterniond inverse_q = q.conjugate();
  return {inverse_q * (-p), inverse_q};
}

Eigen::Quaterniond quaternion_from_rpy(const Eigen::Vector3d& rpy) {
  return (Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()))
      .normalized();
}

Eigen::Vector3d rpy_from_quaternion(const Eigen::Quaterniond& q) {
  const Eigen::Matrix3d r = q.toRotationMatrix();
  const double pitch = std::asin(std::clamp(-r(2, 0), -1.0, 1.0));
  // At pitch = ±90° roll and yaw turn about one axis: yaw gets the whole turn.
  if (std::abs(r(2, 0)) > 1.0 - 1e-12) {
    return {0.0, pitch, std::atan2(-r(0, 1), r(1, 1))};
  }
  return {std::atan2(r(2, 1), r(2, 2)), pitch, std::atan2(r(1, 0), r(0, 0))};
}

}  // namespace ardee
