// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <memory>
#include <optional>

#include "ardee_sim/core/pose.h"
#include "ardee_sim/render/lens.h"

namespace ardee::render {

/// Constant motion of a camera while it takes a picture. Each row is exposed for
/// `exposure_time_s`; row r of n begins r / n of `readout_time_s` after the first one.
struct CameraMotion {
  Twist twist_W;  // linear velocity of the camera's origin, angular velocity
  double exposure_time_s = 0.0;
  double readout_time_s = 0.0;

  bool is_seen() const {
    return (exposure_time_s > 0.0 || readout_time_s > 0.0) &&
           !(twist_W.linear.isZero(0.0) && twist_W.angular.isZero(0.0));
  }
};

/// Camera with SDF's axes: x forward, y left, z up.
struct Camera {
  Pose X_WC;  // when the exposure of the first row begins
  CameraMotion motion;
  int width = 1280;
  int height = 720;
  double horizontal_fov_rad = 1.0471975511965976;  // 60 degrees; only without a lens
  std::shared_ptr<const UndistortionMap> lens;     // of this size; null: a pinhole in the middle
  double near_m = 0.0;                             // along the axis: nearer points are invisible
  double far_m = std::numeric_limits<double>::infinity();

  /// Returns the pose at a time since the exposure of the first row began.
  Pose pose_at(double time_s) const;
  /// Returns the number of pixels between the middle of the picture and 45 degrees off axis.
  double focal_length_px() const;
  /// Returns the direction in the camera's axes through (x, y) in pixels, of length 1 along the
  /// axis; (0, 0) is the upper left corner of the upper left pixel. It is not finite if the lens
  /// lets no light through.
  Eigen::Vector3d direction_C(double x_px, double y_px) const {
    return direction_C(x_px, y_px, focal_length_px());
  }
  /// Returns the same for a focal length that is known already; many rays ask once.
  Eigen::Vector3d direction_C(double x_px, double y_px, double focal_px) const;
  /// Returns whether direction_C is linear in x and y.
  bool is_straight() const { return !lens || lens->lens().is_straight(); }
  /// Returns the unit direction in the world.
  Eigen::Vector3d direction_W(double x_px, double y_px) const;
  /// Returns the place of a point in the picture; none behind the camera.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point_W) const;
};

/// Returns the pose of a camera at `eye_W` that looks at `target_W`, z upwards in the picture.
/// Throws Error if they are equal.
Pose look_at(const Eigen::Vector3d& eye_W, const Eigen::Vector3d& target_W);

}  // namespace ardee::render
