// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ardee_sim/description/scenery.h"

namespace ardee::bench {

/// Triangles without structure, in the world or in a model's frame.
struct TriangleSoup {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  /// Adds visuals of a description's own links under X and scale; of heightmaps only the part
  /// within `radius_m` of `center` along x and y. Throws Error for a shape other than mesh,
  /// heightmap and plane.
  void add(const Model& model, const Pose& X, double scale, const Eigen::Vector2d& center,
           double radius_m);

 private:
  void add_mesh(const Mesh& mesh, const Pose& X, double scale);
  void add_heightmap(const Heightmap& map, const Pose& X, const Eigen::Vector2d& center,
                     double radius_m);
  void add_plane(const Plane& plane, const Pose& X);
};

}  // namespace ardee::bench
