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

std::vector<HeightPatch> HeightSurface::patches() const {
  std::vector<HeightPatch> result;
  const int columns = grid().columns - 1, rows = grid().rows - 1;
  for (int row = 0; row < rows; row += kPatchCells) {
    for (int column = 0; column < columns; column += kPatchCells) {
      result.push_back({column, row, std::min(kPatchCells, columns - column),
                        std::min(kPatchCells, rows - row)});
    }
  }
  return result;
}

Eigen::Vector3d HeightSurface::smooth_normal(const Eigen::Vector2d& point) const {
  const HeightGrid& heights = grid();
  const Eigen::Vector2d& cell_m = cell_size_m();
  const auto slope_at = [&](int column, int row) -> Eigen::Vector2d {
    const int left = std::max(column - 1, 0), right = std::min(column + 1, heights.columns - 1);
    const int below = std::max(row - 1, 0), above = std::min(row + 1, heights.rows - 1);
    const float dx = heights.at(right, row) - heights.at(left, row);
    const float dy = heights.at(column, above) - heights.at(column, below);
    return {static_cast<double>(dx) / ((right - left) * cell_m.x()),
            static_cast<double>(dy) / ((above - below) * cell_m.y())};
  };
  const Eigen::Vector2d at = place(point);
  const auto [column, row] = cell_at(at);
  const double u = std::clamp(at.x() - column, 0.0, 1.0);
  const double v = std::clamp(at.y() - row, 0.0, 1.0);
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
  const Eigen::Vector2d origin = place(ray.origin.head<2>());
  const Eigen::Vector2d direction = ray.direction.head<2>().cwiseQuotient(cell_size_m());
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
    const double z0 = ray.origin.z() + t0 * ray.direction.z();
    const double z1 = ray.origin.z() + t1 * ray.direction.z();
    const double low = std::min(z0, z1) - kCellMargin;
    const double high = std::max(z0, z1) + kCellMargin;
    const int last = patch.column + patch.columns - 1;
    const int from = std::clamp(static_cast<int>(std::floor(std::min(x0, x1) - kCellMargin)),
                                patch.column, last);
    const int to = std::clamp(static_cast<int>(std::floor(std::max(x0, x1) + kCellMargin)),
                              patch.column, last);
    for (int column = from; column <= to; ++column) {
      const float h00 = grid().at(column, row), h10 = grid().at(column + 1, row);
      const float h01 = grid().at(column, row + 1), h11 = grid().at(column + 1, row + 1);
      if (std::max({h00, h10, h01, h11}) < low || std::min({h00, h10, h01, h11}) > high) continue;
      const int cell = row * (grid().columns - 1) + column;
      for (int half = 0; half < 2; ++half) {
        const auto [a, b, c] = corners(column, row, half);
        TriangleHit hit;
        if (!intersect_triangle(ray, a, b, c, hit)) continue;
        found(hit, static_cast<std::uint32_t>(2 * cell + half));
      }
    }
  }
}

}  // namespace ardee::raycast
