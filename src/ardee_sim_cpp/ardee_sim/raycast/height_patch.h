// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>

#include "ardee_sim/description/geometry.h"
#include "ardee_sim/raycast/bounds.h"
#include "ardee_sim/raycast/exact.h"

namespace ardee::raycast {

/// Square of cells of a height grid, intersected by one ray query at once.
struct HeightPatch {
  int column = 0;  // the first cell
  int row = 0;
  int columns = 0;  // cells
  int rows = 0;
};

constexpr int kPatchCells = 8;

/// Surface of heights: each cell is two triangles, cut from (column, row) to (column + 1, row + 1).
/// This is the cut of ODE's dHeightfield (from sample (x + 1, z) to (x, z + 1)): its y axis is
/// turned up about x, and its z then runs against the rows.
class HeightSurface {
 public:
  HeightSurface(std::shared_ptr<const HeightGrid> grid, const Eigen::Vector3d& position_m);

  std::vector<HeightPatch> patches() const;
  Eigen::Vector3d vertex(int column, int row) const;
  /// Returns the unit normal at a point of a smooth surface through the heights.
  Eigen::Vector3d smooth_normal(const Eigen::Vector2d& point) const;
  Bounds bounds(const HeightPatch& patch) const;
  /// Calls `found` for each triangle hit with t in [0, t_high]; the number of a triangle is 2 *
  /// cell or 2 * cell + 1.
  void intersect(const HeightPatch& patch, const Ray& ray, double t_high,
                 const std::function<void(const TriangleHit&, std::uint32_t)>& found) const;

 private:
  std::shared_ptr<const HeightGrid> grid_;
  Eigen::Vector3d corner_m_;  // column 0, row 0
  Eigen::Vector2d cell_m_;
};

}  // namespace ardee::raycast
