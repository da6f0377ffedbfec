// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "ardee_sim/core/pose.h"
#include "ardee_sim/description/height_mesh.h"

namespace ardee::physics {

/// One triangle of a height field, counter-clockwise seen from above, with its upward unit normal.
struct FieldTriangle {
  Eigen::Vector3d a, b, c;
  Eigen::Vector3d normal;

  /// Whether (x, y) lies within the triangle in plan view, edges included.
  bool covers(double x, double y) const;
  /// Height of the triangle's plane at (x, y).
  double height(double x, double y) const;
};

/// The range of cells under a region of the plan; empty where the region misses the field.
struct CellRange {
  int first_column = 0;
  int last_column = -1;
  int first_row = 0;
  int last_row = -1;

  bool empty() const { return last_column < first_column || last_row < first_row; }
};

/// A height grid as terrain that bodies touch.
class HeightField : public HeightMesh {
 public:
  explicit HeightField(std::shared_ptr<const HeightGrid> height_grid);

  CellRange cells(double min_x, double min_y, double max_x, double max_y) const;
  FieldTriangle triangle(int column, int row, int half) const;
  /// The triangle under (x, y); none outside the field.
  std::optional<FieldTriangle> triangle_at(double x, double y) const;
  /// Height of the highest corner of a range of cells.
  double highest(const CellRange& range) const;
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }

 private:
  Eigen::AlignedBox3d bounds_;
};

}  // namespace ardee::physics
