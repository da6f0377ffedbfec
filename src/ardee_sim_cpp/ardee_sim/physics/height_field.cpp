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

int clamp_cell(double cell, int cells) {
  return static_cast<int>(std::clamp(std::floor(cell), 0.0, static_cast<double>(cells - 1)));
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

HeightField::HeightField(std::shared_ptr<const HeightGrid> grid) : grid_(std::move(grid)) {
  origin_ = -0.5 * grid_->size_m;
  cell_ = {grid_->size_m.x() / (grid_->columns - 1), grid_->size_m.y() / (grid_->rows - 1)};
  const auto [low, high] = std::minmax_element(grid_->heights_m.begin(), grid_->heights_m.end());
  bounds_.extend(Eigen::Vector3d(origin_.x(), origin_.y(), *low));
  bounds_.extend(Eigen::Vector3d(-origin_.x(), -origin_.y(), *high));
}

CellRange HeightField::cells(double min_x, double min_y, double max_x, double max_y) const {
  if (max_x < bounds_.min().x() || min_x > bounds_.max().x() || max_y < bounds_.min().y() ||
      min_y > bounds_.max().y()) {
    return {};
  }
  CellRange range;
  range.first_column = clamp_cell((min_x - origin_.x()) / cell_.x(), grid_->columns - 1);
  range.last_column = clamp_cell((max_x - origin_.x()) / cell_.x(), grid_->columns - 1);
  range.first_row = clamp_cell((min_y - origin_.y()) / cell_.y(), grid_->rows - 1);
  range.last_row = clamp_cell((max_y - origin_.y()) / cell_.y(), grid_->rows - 1);
  return range;
}

Eigen::Vector3d HeightField::vertex(int column, int row) const {
  return {origin_.x() + column * cell_.x(), origin_.y() + row * cell_.y(),
          static_cast<double>(grid_->at(column, row))};
}

FieldTriangle HeightField::triangle(int column, int row, int half) const {
  const Eigen::Vector3d low = vertex(column, row);
  const Eigen::Vector3d high = vertex(column + 1, row + 1);
  FieldTriangle result{low, high, high, {0, 0, 1}};
  if (half == 0) {
    result.b = vertex(column + 1, row);
  } else {
    result.c = vertex(column, row + 1);
  }
  result.normal = (result.b - result.a).cross(result.c - result.a).normalized();
  return result;
}

std::optional<FieldTriangle> HeightField::triangle_at(double x, double y) const {
  const CellRange range = cells(x, y, x, y);
  if (range.empty()) return std::nullopt;
  const double u = (x - origin_.x()) / cell_.x() - range.first_column;
  const double v = (y - origin_.y()) / cell_.y() - range.first_row;
  return triangle(range.first_column, range.first_row, u >= v ? 0 : 1);
}

double HeightField::highest(const CellRange& range) const {
  float highest = grid_->at(range.first_column, range.first_row);
  for (int row = range.first_row; row <= range.last_row + 1; ++row) {
    for (int column = range.first_column; column <= range.last_column + 1; ++column) {
      highest = std::max(highest, grid_->at(column, row));
    }
  }
  return static_cast<double>(highest);
}

}  // namespace ardee::physics
