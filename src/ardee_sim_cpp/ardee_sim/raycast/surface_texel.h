// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace ardee::raycast {

/// Piece of a triangle in a triangle scene, about as wide as a pixel sees it. Values that follow
/// from the texel alone may be kept for other pictures, whichever picture computes them first.
struct SurfaceTexel {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  std::uint32_t triangle = kNone;
  std::uint32_t column = 0;  // along the triangle's longest side
  std::uint32_t row = 0;
  std::uint32_t columns = 0;
  std::int16_t size = 0;  // at most 2^size m wide
  bool from_behind = false;

  bool none() const { return triangle == kNone; }
};

/// Place where a primary ray has hit a triangle of a triangle scene, and the greatest width of the
/// texel there.
struct TexelRequest {
  std::uint32_t triangle;
  float u;
  float v;
  float range_m;
  float width_m;      // negative: the triangle is seen from behind
  std::uint32_t ray;  // index through all blocks
};

/// Triangle cut into rows along its longest side, its base, and these into texels.
class TriangleTexels {
 public:
  TriangleTexels() = default;
  /// Takes the base from the first corner to the second, and the way from the first to the third.
  TriangleTexels(const Eigen::Vector3f& base, const Eigen::Vector3f& to_top);

  SurfaceTexel texel(const TexelRequest& request) const;
  /// Finds a place in the texel and in the triangle, as near to the texel's middle as possible: the
  /// shares of the second and the third corner.
  void middle(const SurfaceTexel& texel, float& u, float& v) const;

 private:
  float base_m_ = 0.0f;
  float height_m_ = 0.0f;
  float lean_ = 0.0f;  // the third corner's place along the base, as a share
};

}  // namespace ardee::raycast
