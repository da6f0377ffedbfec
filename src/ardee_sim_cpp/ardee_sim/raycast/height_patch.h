// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "ardee_sim/description/height_mesh.h"
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

/// A height grid as a surface that rays meet.
class HeightSurface : public HeightMesh {
 public:
  using HeightMesh::HeightMesh;

  std::vector<HeightPatch> patches() const;
  /// Returns the unit normal at a point of a smooth surface through the heights.
  Eigen::Vector3d smooth_normal(const Eigen::Vector2d& point) const;
  Bounds bounds(const HeightPatch& patch) const;
  /// Calls `found` for each triangle hit with t in [0, t_high]; the number of a triangle is 2 *
  /// cell or 2 * cell + 1.
  void intersect(const HeightPatch& patch, const Ray& ray, double t_high,
                 const std::function<void(const TriangleHit&, std::uint32_t)>& found) const;
};

}  // namespace ardee::raycast
