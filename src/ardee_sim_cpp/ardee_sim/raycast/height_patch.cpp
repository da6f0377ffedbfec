// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/height_patch.h"

#include <algorithm>
#include <cmath>

namespace ardee::raycast {
namespace {

/// Distance from the ray, as a share of a cell, within which a cell is tried as well, so that
/// rounding loses none.
constexpr double kCellMargin = 1e-6;

/// Narrows [t_low, t_high] to the part with origin + t * direction in [low, high].
bool clip(double origin, double direction, double low, double high, double& t_low, double& t_high) {
  if (direction == 0.0) return origin >= low && origin <= high;
  const double a = (low - origin) / direction;
  const double b = (high - origin) / direction;
  t_low = std::max(t_low, std::min(a, b));
  t_high = std::min(t_high, std::max(a, b));
  return t_low <= t_high;
}

}  // namespace

HeightSurface::HeightSurface(std::shared_ptr<const HeightGrid> grid,
                             const Eigen::Vector3d& position_m)
    : grid_(std::move(grid)),
      corner_m_(position_m - 0.5 * Eigen::Vector3d(grid_->size_m.x(), grid_->size_m.y(), 0.0)),
      cell_m_(grid_->size_m.x() / (grid_->columns - 1), grid_->size_m.y() / (grid_->rows - 1)) {}

Eigen::Vector3d HeightSurface::vertex(int column, int row) const {
  return corner_m_ + Eigen::Vector3d(column * cell_m_.x(), row * cell_m_.y(),
                                     static_cast<double>(grid_->at(column, row)));
}

std::vector<HeightPatch> HeightSurface::patches() const {
  std::vector<HeightPatch> result;
  for (int row = 0; row < grid_->rows - 1; row += kPatchCells) {
    for (int column = 0; column < grid_->columns - 1; column += kPatchCells) {
      result.push_back({column, row, std::min(kPatchCells, grid_->columns - 1 - column),
                        std::min(kPatchCells, grid_->rows - 1 - row)});
    }
  }
  return result;
}

Eigen::Vector3d HeightSurface::smooth_normal(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d place = (point - corner_m_.head<2>()).cwiseQuotient(cell_m_);
  const auto slope_at = [this](int column, int row) -> Eigen::Vector2d {
    const int left = std::max(column - 1, 0), right = std::min(column + 1, grid_->columns - 1);
    const int below = std::max(row - 1, 0), above = std::min(row + 1, grid_->rows - 1);
    const float dx = grid_->at(right, row) - grid_->at(left, row);
    const float dy = grid_->at(column, above) - grid_->at(column, below);
    return {static_cast<double>(dx) / ((right - left) * cell_m_.x()),
            static_cast<double>(dy) / ((above - below) * cell_m_.y())};
  };
  const int column = std::clamp(static_cast<int>(std::floor(place.x())), 0, grid_->columns - 2);
  const int row = std::clamp(static_cast<int>(std::floor(place.y())), 0, grid_->rows - 2);
  const double u = std::clamp(place.x() - column, 0.0, 1.0);
  const double v = std::clamp(place.y() - row, 0.0, 1.0);
  const Eigen::Vector2d slope =
      (1.0 - v) * ((1.0 - u) * slope_at(column, row) + u * slope_at(column + 1, row)) +
      v * ((1.0 - u) * slope_at(column, row + 1) + u * slope_at(column + 1, row + 1));
  return Eigen::Vector3d(-slope.x(), -slope.y(), 1.0).normalized();
}

Bounds HeightSurface::bounds(const HeightPatch& patch) const {
  Bounds result;
  for (int row = patch.row; row <= patch.row + patch.rows; ++row) {
    for (int column = patch.column; column <= patch.column + patch.columns; ++column) {
      result.add(vertex(column, row));
    }
  }
  return result;
}

void HeightSurface::intersect(
    const HeightPatch& patch, const Ray& ray, double t_high,
    const std::function<void(const TriangleHit&, std::uint32_t)>& found) const {
  // Cells are visited row by row: the columns that the ray crosses within the row's strip.
  const Eigen::Vector2d origin = (ray.origin - corner_m_).head<2>().cwiseQuotient(cell_m_);
  const Eigen::Vector2d direction = ray.direction.head<2>().cwiseQuotient(cell_m_);
  for (int row = patch.row; row < patch.row + patch.rows; ++row) {
    double t0 = 0.0;
    double t1 = t_high;
    if (!clip(origin.y(), direction.y(), row - kCellMargin, row + 1 + kCellMargin, t0, t1) ||
        !clip(origin.x(), direction.x(), patch.column - kCellMargin,
              patch.column + patch.columns + kCellMargin, t0, t1)) {
      continue;
    }
    const double x0 = origin.x() + t0 * direction.x();
    const double x1 = origin.x() + t1 * direction.x();
    const double z0 = ray.origin.z() + t0 * ray.direction.z() - corner_m_.z();
    const double z1 = ray.origin.z() + t1 * ray.direction.z() - corner_m_.z();
    const double low = std::min(z0, z1) - kCellMargin;
    const double high = std::max(z0, z1) + kCellMargin;
    const int last = patch.column + patch.columns - 1;
    const int from = std::clamp(static_cast<int>(std::floor(std::min(x0, x1) - kCellMargin)),
                                patch.column, last);
    const int to = std::clamp(static_cast<int>(std::floor(std::max(x0, x1) + kCellMargin)),
                              patch.column, last);
    for (int column = from; column <= to; ++column) {
      const float h00 = grid_->at(column, row), h10 = grid_->at(column + 1, row);
      const float h01 = grid_->at(column, row + 1), h11 = grid_->at(column + 1, row + 1);
      if (std::max({h00, h10, h01, h11}) < low || std::min({h00, h10, h01, h11}) > high) continue;
      const Eigen::Vector3d v00 = vertex(column, row);
      const Eigen::Vector3d v11 = vertex(column + 1, row + 1);
      const auto cell = static_cast<std::uint32_t>(row * (grid_->columns - 1) + column);
      TriangleHit hit;
      if (intersect_triangle(ray, v00, vertex(column + 1, row), v11, hit)) found(hit, 2 * cell);
      if (intersect_triangle(ray, v00, v11, vertex(column, row + 1), hit)) found(hit, 2 * cell + 1);
    }
  }
}

}  // namespace ardee::raycast
