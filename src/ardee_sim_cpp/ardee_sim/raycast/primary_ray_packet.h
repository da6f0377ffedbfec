// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace ardee::raycast {

/// Sixteen rays of a picture from its eye, and the data of their hits that show whether neighbours
/// see one surface; `PictureTracer::interpolate_hits` adds the rest. Each number is an array, for
/// vector instructions.
struct PrimaryRayPacket {
  static constexpr int kRays = 16;
  /// Surface number of a ray without a hit.
  static constexpr std::uint32_t kNothing = 0;
  /// Number of a triangle scene's first surface; the caller uses 1 for pixels without a ray.
  static constexpr std::uint32_t kFirstSurface = 2;
  /// Bit of surfaces and triangles that are not in a triangle scene.
  static constexpr std::uint32_t kOutside = 0x80000000u;

  alignas(64) float x_W[kRays];  // unit directions
  alignas(64) float y_W[kRays];
  alignas(64) float z_W[kRays];
  alignas(64) float near_m[kRays];  // hits count from near_m to far_m
  alignas(64) float far_m[kRays];

  alignas(64) std::uint32_t surface[kRays];  // the same for points of one surface
  alignas(
      64) std::uint32_t triangle[kRays];  // the same for points of one triangle of a triangle scene
  alignas(64) float u[kRays];             // place on it: the shares of its second corner
  alignas(64) float v[kRays];             // and of its third corner
  alignas(64) float range_m[kRays];       // distance from the eye; +inf: no hit
  alignas(64) float normal_x_W[kRays];    // unit, to either side; 0: no hit
  alignas(64) float normal_y_W[kRays];
  alignas(64) float normal_z_W[kRays];

  void set_direction(int i, const Eigen::Vector3f& direction_W) {
    x_W[i] = direction_W.x();
    y_W[i] = direction_W.y();
    z_W[i] = direction_W.z();
  }
  Eigen::Vector3f direction_W(int i) const { return {x_W[i], y_W[i], z_W[i]}; }
  Eigen::Vector3f normal_W(int i) const { return {normal_x_W[i], normal_y_W[i], normal_z_W[i]}; }
  bool met(int i) const { return surface[i] != kNothing; }
};

}  // namespace ardee::raycast
