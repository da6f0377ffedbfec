// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>

namespace ardee {

/// Rigid transform X_AB: maps a point given in frame B into frame A. Position in metres, unit
/// quaternion.
struct Pose {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();

  /// From metres and radians; roll, pitch, yaw about the fixed x, y, z axes (the convention of URDF
  /// and SDF).
  static Pose from_xyz_rpy(const Eigen::Vector3d& xyz, const Eigen::Vector3d& rpy);

  Pose operator*(const Pose& other) const { return {p + q * other.p, (q * other.q).normalized()}; }
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const { return p + q * point; }
  Pose inverse() const;
  bool is_finite() const { return p.allFinite() && q.coeffs().allFinite(); }
};

/// Roll, pitch, yaw in radians of a rotation; the inverse of Pose::from_xyz_rpy.
Eigen::Vector3d rpy_from_quaternion(const Eigen::Quaterniond& q);

/// Rotation from roll, pitch, yaw in radians about the fixed axes.
Eigen::Quaterniond quaternion_from_rpy(const Eigen::Vector3d& rpy);

/// Linear (m/s) and angular (rad/s) velocity; the user of the struct states the frame.
struct Twist {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();
};

}  // namespace ardee
