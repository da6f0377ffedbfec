// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "ardee_sim/raycast/bounds.h"

namespace ardee::raycast {

constexpr int kBlockLanes = 16;

/// Sixteen neighbouring triangles side by side, for one pass of vector instructions. Coordinates
/// are floats relative to the block's centre: they only sort out; what is left is decided in double
/// precision from the vertices themselves.
struct alignas(64) TriangleBlock {
  using Lanes = float[kBlockLanes];

  Lanes vertex[3];  // v0
  Lanes edge1[3];   // v1 - v0
  Lanes edge2[3];   // v2 - v0
  float radius = 0.0f;
  float longest = 0.0f;  // edge
  Eigen::Vector3d center;
  std::uint32_t first = 0;  // index of lane 0 among the body's triangles
  std::uint32_t count = 0;  // lanes in use; the others repeat the last
};

/// A ray in the axes of the block, its origin close to and relative to the block's centre.
struct BlockRay {
  float origin[3];
  float direction[3];
  float t_low;
  float t_high;
  float slack_m;  // how far the ray may be off
};

/// The triangles that the ray may meet, a bit each: all that it does meet are among them.
std::uint32_t cull_conservatively(const TriangleBlock& block, const BlockRay& ray);

/// Where a block stands in a local scene: its centre, and what turns (and scales) the local scene's
/// axes into the block's.
struct BlockPlace {
  float m[3][3];
  float scale;
};

/// A unit ray in a local scene, from t = 0 on.
struct LocalRay {
  float origin[3];
  float direction[3];
  float t_high;
};

/// The same for a placed block; `slack_m` is how far the local scene's floats may be off.
std::uint32_t cull_conservatively(const TriangleBlock& block, const BlockPlace& place,
                                  const float center[3], const LocalRay& ray, float slack_m);

/// The box about a block, turned and scaled by `m`, its centre moved to `center`.
void block_bounds(const TriangleBlock& block, const float m[3][3], const float center[3],
                  float lower[3], float upper[3]);

}  // namespace ardee::raycast
