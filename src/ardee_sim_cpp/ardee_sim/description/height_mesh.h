// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>

#include "ardee_sim/description/geometry.h"

namespace ardee {

/// A height grid as triangles, in the grid's own frame F and unscaled metres: vertex (column, row)
/// lies at -size / 2 + (column, row) * cell. Each cell is two triangles, cut from (column, row) to
/// (column + 1, row + 1). That is the cut of ODE's dHeightfield (from sample (x + 1, z) to (x, z +
/// 1)) when its y axis is turned up about x, its z then running against the rows. Reads the shared
/// grid and copies nothing; find_fault must have found no fault in it.
class HeightMesh {
 public:
  struct Cell {
    int column;
    int row;
  };
  /// Corners of the lower right and the upper left triangle of the cell (0, 0), counter-clockwise
  /// from above.
  static constexpr Cell kCut[2][3] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};

  explicit HeightMesh(std::shared_ptr<const HeightGrid> grid);

  const HeightGrid& grid() const { return *grid_; }
  const Eigen::Vector2d& cell_size_m() const { return cell_m_; }
  Eigen::Vector3d vertex(int column, int row) const {
    return {corner_m_.x() + column * cell_m_.x(), corner_m_.y() + row * cell_m_.y(),
            static_cast<double>(grid_->at(column, row))};
  }
  /// Corners of the lower right (half 0) or upper left (half 1) triangle of a cell.
  std::array<Eigen::Vector3d, 3> corners(int column, int row, int half) const;
  /// Column and row of a point in plan, whole at a vertex.
  Eigen::Vector2d place(const Eigen::Vector2d& point_F) const {
    return (point_F - corner_m_).cwiseQuotient(cell_m_);
  }
  /// The cell of a place; the nearest one if the place lies outside the grid.
  Cell cell_at(const Eigen::Vector2d& place) const;

 private:
  std::shared_ptr<const HeightGrid> grid_;
  Eigen::Vector2d corner_m_;  // of column 0, row 0
  Eigen::Vector2d cell_m_;
};

}  // namespace ardee
