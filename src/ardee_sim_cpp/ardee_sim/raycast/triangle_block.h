// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "ardee_sim/raycast/bounds.h"

namespace ardee::raycast {

constexpr int kBlockLanes = 16;
/// Float arithmetic within a block errs by a few parts in 2^24 of its size.
constexpr double kBlockSlack = 2e-6;

/// Sixteen neighbouring triangles side by side, for one pass of vector instructions. Coordinates
/// are floats relative to the block's centre: they only choose candidates, which are decided in
/// double precision from the vertices themselves.
struct alignas(64) TriangleBlock {
  using Lanes = float[kBlockLanes];

  Lanes vertex[3];  // v0
  Lanes edge1[3];   // v1 - v0
  Lanes edge2[3];   // v2 - v0
  float radius = 0.0f;
  float longest = 0.0f;  // longest edge
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
  float slack_m;  // greatest error of the ray
};

/// Returns the triangles that the ray may hit, a bit each: all that it does hit are among them.
std::uint32_t cull_conservatively(const TriangleBlock& block, const BlockRay& ray);

/// Place of a block in a local scene: its centre, and the matrix that turns (and scales) the local
/// scene's axes into the block's.
struct BlockPlace {
  float m[3][3];
  float scale;
};

/// Unit ray in a local scene, from t = 0 on.
struct LocalRay {
  float origin[3];
  float direction[3];
  float t_high;
};

/// Does the same for a placed block; `slack_m` is the greatest error of the local scene's floats.
std::uint32_t cull_conservatively(const TriangleBlock& block, const BlockPlace& place,
                                  const float center[3], const LocalRay& ray, float slack_m);

/// Computes the box about a block, turned and scaled by `m`, its centre moved to `center`.
void block_bounds(const TriangleBlock& block, const float m[3][3], const float center[3],
                  float lower[3], float upper[3]);

}  // namespace ardee::raycast
