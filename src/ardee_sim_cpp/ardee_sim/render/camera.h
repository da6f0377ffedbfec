// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <memory>
#include <optional>

#include "ardee_sim/core/pose.h"
#include "ardee_sim/render/lens.h"

namespace ardee::render {

/// A camera with SDF's axes: x forward, y left, z up.
struct Camera {
  Pose X_WC;
  int width = 1280;
  int height = 720;
  double horizontal_fov_rad = 1.0471975511965976;  // 60 degrees; without a lens
  std::shared_ptr<const UndistortionMap> lens;     // of this size; null: a pinhole in the middle
  double near_m = 0.0;                             // along the axis: what is nearer is not seen
  double far_m = std::numeric_limits<double>::infinity();

  /// Pixels between the middle of the picture and 45 degrees off axis.
  double focal_length_px() const;
  /// The direction in the camera's axes through (x, y) in pixels, of length 1 along the axis;
  /// (0, 0) is the upper left corner of the upper left pixel. Not finite where a lens lets no light
  /// through.
  Eigen::Vector3d direction_C(double x_px, double y_px) const;
  /// Whether direction_C is linear in x and y.
  bool is_straight() const { return !lens || lens->lens().is_straight(); }
  /// The unit direction in the world.
  Eigen::Vector3d direction_W(double x_px, double y_px) const;
  /// Where in the picture a point lies; none behind the camera.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point_W) const;
};

/// A camera's pose at `eye_W` that looks at `target_W`, z upwards in the picture. Throws Error if
/// they are the same.
Pose look_at(const Eigen::Vector3d& eye_W, const Eigen::Vector3d& target_W);

}  // namespace ardee::render
