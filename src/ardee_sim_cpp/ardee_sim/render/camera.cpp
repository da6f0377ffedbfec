// SPDX-License-Identifier: MIT
#include "ardee_sim/render/camera.h"

#include <cmath>

#include "ardee_sim/core/error.h"

namespace ardee::render {

Pose Camera::pose_at(double time_s) const {
  const Twist& twist = motion.twist_W;
  const double speed_rad_per_s = twist.angular.norm();
  if (speed_rad_per_s == 0.0) return {X_WC.p + time_s * twist.linear, X_WC.q};
  const Eigen::AngleAxisd turn(time_s * speed_rad_per_s, twist.angular / speed_rad_per_s);
  return {X_WC.p + time_s * twist.linear, (turn * X_WC.q).normalized()};
}

double Camera::focal_length_px() const {
  return lens ? lens->lens().fx_px : 0.5 * width / std::tan(0.5 * horizontal_fov_rad);
}

Eigen::Vector3d Camera::direction_C(double x_px, double y_px, double focal_px) const {
  if (lens) {
    const Eigen::Vector2d plane = lens->plane(x_px, y_px);
    return {1.0, -plane.x(), -plane.y()};
  }
  return {1.0, (0.5 * width - x_px) / focal_px, (0.5 * height - y_px) / focal_px};
}

Eigen::Vector3d Camera::direction_W(double x_px, double y_px) const {
  return X_WC.q * direction_C(x_px, y_px).normalized();
}

std::optional<Eigen::Vector2d> Camera::project(const Eigen::Vector3d& point_W) const {
  const Eigen::Vector3d point_C = X_WC.q.conjugate() * (point_W - X_WC.p);
  if (!(point_C.x() > 0.0)) return std::nullopt;
  const Eigen::Vector2d plane = -point_C.tail<2>() / point_C.x();
  if (lens) return lens->lens().to_pixel(plane) + Eigen::Vector2d(0.5, 0.5);
  return focal_length_px() * plane + 0.5 * Eigen::Vector2d(width, height);
}

Pose look_at(const Eigen::Vector3d& eye_W, const Eigen::Vector3d& target_W) {
  const Eigen::Vector3d way = target_W - eye_W;
  if (!way.allFinite() || way.norm() < 1e-9) {
    throw Error("found a camera at the point that it looks at, expected two different points");
  }
  const double yaw = way.head<2>().norm() > 1e-12 ? std::atan2(way.y(), way.x()) : 0.0;
  const double pitch = -std::atan2(way.z(), way.head<2>().norm());
  return Pose::from_xyz_rpy(eye_W, {0.0, pitch, yaw});
}

}  // namespace ardee::render
