// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

namespace ardee::render {

/// Calibrated lens in the terms of sensor_msgs/CameraInfo: axes x right, y down, z forward; whole
/// pixel coordinates are centres of pixels; points of the picture plane are (x/z, y/z).
struct Lens {
  double fx_px = 1.0;
  double fy_px = 1.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  double skew_px = 0.0;       // shift of a row to the right, for each unit of y / z
  std::array<double, 5> D{};  // plumb_bob: k1, k2, t1, t2, k3 (Brown 1966, as in OpenCV)

  /// Returns a straight lens whose axis passes through the middle of the picture.
  static Lens pinhole(int width, int height, double horizontal_fov_rad);

  bool is_straight() const { return D == std::array<double, 5>{}; }
  /// Returns the place to which the distortion moves a point of the picture plane.
  Eigen::Vector2d distort(const Eigen::Vector2d& plane) const;
  /// Returns the inverse of distort; none where no light comes from (beyond the fold of a barrel
  /// distortion).
  std::optional<Eigen::Vector2d> undistort(const Eigen::Vector2d& bent) const;
  /// Returns the pixel coordinates of a point of the picture plane before distortion.
  Eigen::Vector2d to_pixel(const Eigen::Vector2d& plane) const;
  /// Returns the point of the picture plane after distortion that a pixel shows.
  Eigen::Vector2d distorted_plane(const Eigen::Vector2d& pixel) const {
    const double y = (pixel.y() - cy_px) / fy_px;
    return {(pixel.x() - cx_px - skew_px * y) / fx_px, y};
  }
  /// Returns the inverse of to_pixel.
  std::optional<Eigen::Vector2d> to_plane(const Eigen::Vector2d& pixel) const;
};

/// Lens with a table of its inverse for a whole picture.
class UndistortionMap {
 public:
  UndistortionMap(const Lens& lens, int width, int height);

  const Lens& lens() const { return lens_; }
  /// Returns the point of the picture plane at (x, y) in pixels, (0, 0) being the upper left corner
  /// of the picture; not finite where no light comes from.
  Eigen::Vector2d plane(double x_px, double y_px) const {
    return corners_.empty() ? lens_.distorted_plane({x_px - 0.5, y_px - 0.5})
                            : between_corners(x_px, y_px);
  }

 private:
  Eigen::Vector2d between_corners(double x_px, double y_px) const;

  Lens lens_;
  int width_;
  int height_;
  std::vector<Eigen::Vector2d> corners_;  // the pixels', row by row; empty: straight
};

}  // namespace ardee::render
