// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace ardee::raycast {

/// A primitive of a triangle in a triangle scene, about as wide as a pixel sees it. What follows
/// from the texel alone may be kept for other pictures: who works it out first does not matter.
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

/// Where a primary ray has hit a triangle of a triangle scene, and how wide the texel there may
/// be.
struct TexelRequest {
  std::uint32_t triangle;
  float u;
  float v;
  float range_m;
  float width_m;      // negative: the triangle is seen from behind
  std::uint32_t ray;  // its number through all blocks
};

/// A triangle cut into rows along its longest side, its base, and these into texels.
class TriangleTexels {
 public:
  TriangleTexels() = default;
  /// The base from the first corner to the second, and the way from the first to the third.
  TriangleTexels(const Eigen::Vector3f& base, const Eigen::Vector3f& to_top);

  SurfaceTexel texel(const TexelRequest& request) const;
  /// Of a place in the texel and in the triangle, as near to the texel's middle as may be: the
  /// shares of the second and the third corner.
  void middle(const SurfaceTexel& texel, float& u, float& v) const;

 private:
  float base_m_ = 0.0f;
  float height_m_ = 0.0f;
  float lean_ = 0.0f;  // where along the base the third corner lies, as a share
};

}  // namespace ardee::raycast
