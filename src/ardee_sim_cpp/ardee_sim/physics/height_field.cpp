// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/height_field.h"

#include <algorithm>
#include <cmath>

namespace ardee::physics {
namespace {

/// Twice the signed area of the plan of (a, b, p), positive if p lies to the left of a -> b.
double side(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double x, double y) {
  return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
}

}  // namespace

bool FieldTriangle::covers(double x, double y) const {
  // A point on a shared edge belongs to both triangles for any rounding.
  const double tolerance = -1e-9 * side(a, b, c.x(), c.y());
  return side(a, b, x, y) >= tolerance && side(b, c, x, y) >= tolerance &&
         side(c, a, x, y) >= tolerance;
}

double FieldTriangle::height(double x, double y) const {
  return a.z() - (normal.x() * (x - a.x()) + normal.y() * (y - a.y())) / normal.z();
}

HeightField::HeightField(std::shared_ptr<const HeightGrid> height_grid)
    : HeightMesh(std::move(height_grid)) {
  const auto [low, high] = std::minmax_element(grid().heights_m.begin(), grid().heights_m.end());
  const Eigen::Vector2d reach = 0.5 * grid().size_m;
  bounds_.extend(Eigen::Vector3d(-reach.x(), -reach.y(), *low));
  bounds_.extend(Eigen::Vector3d(reach.x(), reach.y(), *high));
}

CellRange HeightField::cells(double min_x, double min_y, double max_x, double max_y) const {
  if (max_x < bounds_.min().x() || min_x > bounds_.max().x() || max_y < bounds_.min().y() ||
      min_y > bounds_.max().y()) {
    return {};
  }
  const Cell first = cell_at(place({min_x, min_y}));
  const Cell last = cell_at(place({max_x, max_y}));
  return {first.column, last.column, first.row, last.row};
}

FieldTriangle HeightField::triangle(int column, int row, int half) const {
  const auto [a, b, c] = corners(column, row, half);
  return {a, b, c, (b - a).cross(c - a).normalized()};
}

std::optional<FieldTriangle> HeightField::triangle_at(double x, double y) const {
  if (cells(x, y, x, y).empty()) return std::nullopt;
  const Eigen::Vector2d at = place({x, y});
  const Cell cell = cell_at(at);
  return triangle(cell.column, cell.row, at.x() - cell.column >= at.y() - cell.row ? 0 : 1);
}

double HeightField::highest(const CellRange& range) const {
  float highest = grid().at(range.first_column, range.first_row);
  for (int row = range.first_row; row <= range.last_row + 1; ++row) {
    for (int column = range.first_column; column <= range.last_column + 1; ++column) {
      highest = std::max(highest, grid().at(column, row));
    }
  }
  return static_cast<double>(highest);
}

}  // namespace ardee::physics
