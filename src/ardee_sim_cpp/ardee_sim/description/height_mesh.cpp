// SPDX-License-Identifier: MIT
#include "ardee_sim/description/height_mesh.h"

#include <algorithm>
#include <cmath>

namespace ardee {

HeightMesh::HeightMesh(std::shared_ptr<const HeightGrid> grid)
    : grid_(std::move(grid)),
      corner_m_(-0.5 * grid_->size_m),
      cell_m_(grid_->size_m.x() / (grid_->columns - 1), grid_->size_m.y() / (grid_->rows - 1)) {}

std::array<Eigen::Vector3d, 3> HeightMesh::corners(int column, int row, int half) const {
  const auto corner = [&](int k) {
    return vertex(column + kCut[half][k].column, row + kCut[half][k].row);
  };
  return {corner(0), corner(1), corner(2)};
}

HeightMesh::Cell HeightMesh::cell_at(const Eigen::Vector2d& place) const {
  const auto clamped = [](double cell, int vertices) {
    return static_cast<int>(std::clamp(std::floor(cell), 0.0, vertices - 2.0));
  };
  return {clamped(place.x(), grid_->columns), clamped(place.y(), grid_->rows)};
}

}  // namespace ardee
