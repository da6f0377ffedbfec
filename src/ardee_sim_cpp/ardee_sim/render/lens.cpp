// SPDX-License-Identifier: MIT
#include "ardee_sim/render/lens.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace ardee::render {
namespace {

/// Number of steps from the axis outwards, each solved by Newton's method: so the solution stays on
/// the branch that begins at the axis.
constexpr int kSteps = 4;
constexpr int kMostIterations = 12;
constexpr double kTolerance = 1e-13;

Eigen::Matrix2d bend_derivative(const std::array<double, 5>& D, const Eigen::Vector2d& p) {
  const auto [k1, k2, t1, t2, k3] = D;
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = 2.0 * (k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3));  // d radial / dr / r
  Eigen::Matrix2d J;
  J(0, 0) = radial + x * x * slope + 2.0 * t1 * y + 6.0 * t2 * x;
  J(0, 1) = x * y * slope + 2.0 * t1 * x + 2.0 * t2 * y;
  J(1, 0) = J(0, 1);
  J(1, 1) = radial + y * y * slope + 6.0 * t1 * y + 2.0 * t2 * x;
  return J;
}

}  // namespace

Lens Lens::pinhole(int width, int height, double horizontal_fov_rad) {
  Lens lens;
  lens.fx_px = lens.fy_px = 0.5 * width / std::tan(0.5 * horizontal_fov_rad);
  lens.cx_px = 0.5 * (width - 1);
  lens.cy_px = 0.5 * (height - 1);
  return lens;
}

Eigen::Vector2d Lens::distort(const Eigen::Vector2d& plane) const {
  const auto [k1, k2, t1, t2, k3] = D;
  const double x = plane.x(), y = plane.y(), r2 = plane.squaredNorm();
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2.0 * t1 * x * y + t2 * (r2 + 2.0 * x * x),
          y * radial + t1 * (r2 + 2.0 * y * y) + 2.0 * t2 * x * y};
}

std::optional<Eigen::Vector2d> Lens::undistort(const Eigen::Vector2d& bent) const {
  if (is_straight()) return bent;
  Eigen::Vector2d plane(0, 0);
  for (int step = 1; step <= kSteps; ++step) {
    const Eigen::Vector2d goal = bent * step / kSteps;
    for (int k = 0;; ++k) {
      const Eigen::Matrix2d J = bend_derivative(D, plane);
      const Eigen::Vector2d rest = goal - distort(plane);
      if (J.determinant() <= 0.0 || J.trace() <= 0.0 || k == kMostIterations) return std::nullopt;
      plane += J.inverse() * rest;
      if (rest.norm() < kTolerance * (1.0 + goal.norm())) break;
    }
  }
  return plane;
}

Eigen::Vector2d Lens::to_pixel(const Eigen::Vector2d& plane) const {
  const Eigen::Vector2d bent = distort(plane);
  return {fx_px * bent.x() + skew_px * bent.y() + cx_px, fy_px * bent.y() + cy_px};
}

std::optional<Eigen::Vector2d> Lens::to_plane(const Eigen::Vector2d& pixel) const {
  return undistort(distorted_plane(pixel));
}

UndistortionMap::UndistortionMap(const Lens& lens, int width, int height)
    : lens_(lens), width_(width), height_(height) {
  if (lens.is_straight()) return;
  const Eigen::Vector2d nothing =
      Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  corners_.reserve(static_cast<std::size_t>(width + 1) * static_cast<std::size_t>(height + 1));
  for (int row = 0; row <= height; ++row) {
    for (int column = 0; column <= width; ++column) {
      corners_.push_back(lens.to_plane({column - 0.5, row - 0.5}).value_or(nothing));
    }
  }
}

Eigen::Vector2d UndistortionMap::between_corners(double x_px, double y_px) const {
  // The map is linear between the corners of a pixel: the error within a pixel is below a
  // thousandth of it.
  const int column = std::clamp(static_cast<int>(x_px), 0, width_ - 1);
  const int row = std::clamp(static_cast<int>(y_px), 0, height_ - 1);
  const double a = x_px - column;
  const double b = y_px - row;
  const Eigen::Vector2d* upper =
      &corners_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_ + 1) +
                static_cast<std::size_t>(column)];
  const Eigen::Vector2d* lower = upper + width_ + 1;
  return (1.0 - b) * ((1.0 - a) * upper[0] + a * upper[1]) +
         b * ((1.0 - a) * lower[0] + a * lower[1]);
}

}  // namespace ardee::render
