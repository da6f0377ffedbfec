// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>

#include "ardee_sim/description/model.h"
#include "ardee_sim/raycast/ray_hit.h"

namespace ardee::raycast {

/// First hit of a ray with its material, for a picture. The pointers lead into the descriptions
/// that the scene holds.
struct SurfaceInteraction {
  double range_m = std::numeric_limits<double>::infinity();  // +inf: no hit
  std::uint32_t entity = kNoEntity;
  std::uint32_t link = 0;   // index in the model's description
  std::uint32_t shape = 0;  // index of the visual or collision in the link
  std::uint32_t label = 0;
  const Visual* visual = nullptr;      // null in a collision scene
  const Material* material = nullptr;  // the visual's, else the mesh file's; null: none
  bool two_sided = false;
  Eigen::Vector3d normal_W{0, 0, 0};         // unit, towards the ray's origin
  Eigen::Vector3d smooth_normal_W{0, 0, 0};  // between vertex normals, if there are any
  // In the shape's axes; for a mesh, the body's; for a heightmap, those of its grid.
  Eigen::Vector3d point_S{0, 0, 0};
  Eigen::Vector2d uv{0, 0};  // v upwards from the texture's lower edge
  double uv_per_m = 0.0;     // density of (u, v); 0: there are none

  bool met() const { return entity != kNoEntity; }
};

}  // namespace ardee::raycast
