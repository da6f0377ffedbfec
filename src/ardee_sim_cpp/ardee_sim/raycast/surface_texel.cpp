// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/surface_texel.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>

namespace ardee::raycast {
namespace {

/// Exponent of the power of two below a positive number.
std::int16_t exponent_of(float x) {
  std::int32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return static_cast<std::int16_t>((bits >> 23) - 127);
}

float power_of_two(int exponent) {
  const std::int32_t bits = (exponent + 127) << 23;
  float result;
  std::memcpy(&result, &bits, sizeof result);
  return result;
}

/// Numbers of texels of at most 2^size m along a triangle's base, and across.
struct Grid {
  Grid(float base_m, float height_m, std::int16_t size)
      : columns(texels(base_m, size)), rows(texels(height_m, size)) {}
  static float texels(float length_m, std::int16_t size) {
    return static_cast<float>(static_cast<int>(std::min(length_m * power_of_two(-size), kMost)) +
                              1);
  }
  static constexpr float kMost = 1e6f;  // with more, floats could not tell them apart

  float columns;
  float rows;
};

/// Returns which of `count` equal parts of [0, 1] contains a number, or is nearest to it.
std::uint32_t place_in(float x, float count) {
  const float place = x * count;
  return place > 0.0f ? static_cast<std::uint32_t>(std::min(place, count - 1.0f)) : 0u;
}

}  // namespace

TriangleTexels::TriangleTexels(const Eigen::Vector3f& base, const Eigen::Vector3f& to_top)
    : base_m_(base.norm()) {
  if (!(base_m_ > 0.0f)) return;
  height_m_ = base.cross(to_top).norm() / base_m_;
  lean_ = std::clamp(base.dot(to_top) / base.squaredNorm(), 0.0f, 1.0f);
}

SurfaceTexel TriangleTexels::texel(const TexelRequest& request) const {
  SurfaceTexel texel;
  texel.triangle = request.triangle;
  texel.size = exponent_of(std::abs(request.width_m));
  texel.from_behind = request.width_m < 0.0f;
  const Grid grid(base_m_, height_m_, texel.size);
  texel.column = place_in(request.u + lean_ * request.v, grid.columns);
  texel.row = place_in(request.v, grid.rows);
  texel.columns = static_cast<std::uint32_t>(grid.columns);
  return texel;
}

void TriangleTexels::middle(const SurfaceTexel& texel, float& u, float& v) const {
  const Grid grid(base_m_, height_m_, texel.size);
  const float along = (static_cast<float>(texel.column) + 0.5f) / grid.columns;
  const float lower = static_cast<float>(texel.row) / grid.rows;
  const float upper = static_cast<float>(texel.row + 1) / grid.rows;
  // The middle is halfway up the part of the triangle over the column's middle; or, if that ends
  // below the row, the nearest place on the row's lower edge.
  const float top = std::min(along / lean_, (1.0f - along) / (1.0f - lean_));
  v = 0.5f * (lower + std::clamp(top, lower, upper));
  u = std::clamp(along - lean_ * v, 0.0f, 1.0f - v);
}

}  // namespace ardee::raycast
