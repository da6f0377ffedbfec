// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/triangle_block.h"

#include <algorithm>
#include <cmath>

#include "ardee_sim/core/vector_clones.h"

namespace ardee::raycast {
namespace {

/// Möller and Trumbore (1997) for all lanes, with slack at each comparison. A block is loaded more
/// often than it is hit, so values that follow from its edges are computed, not stored.
__attribute__((always_inline)) inline std::uint32_t mark(const TriangleBlock& block,
                                                         const BlockRay& ray) {
  const float ox = ray.origin[0], oy = ray.origin[1], oz = ray.origin[2];
  const float dx = ray.direction[0], dy = ray.direction[1], dz = ray.direction[2];
  const float slack = ray.slack_m;
  const float uv_slack = slack * (std::abs(dx) + std::abs(dy) + std::abs(dz)) * block.longest;
  const float t_slack = slack * block.longest * block.longest;
  std::uint32_t marks = 0;
  for (int i = 0; i < kBlockLanes; ++i) {
    const float cx = block.vertex[0][i] - ox;
    const float cy = block.vertex[1][i] - oy;
    const float cz = block.vertex[2][i] - oz;
    const float ax = block.edge1[0][i], ay = block.edge1[1][i], az = block.edge1[2][i];
    const float bx = block.edge2[0][i], by = block.edge2[1][i], bz = block.edge2[2][i];
    const float nx = ay * bz - az * by;
    const float ny = az * bx - ax * bz;
    const float nz = ax * by - ay * bx;
    const float slope = nx * dx + ny * dy + nz * dz;
    const float height = nx * cx + ny * cy + nz * cz;
    const float rx = cy * dz - cz * dy;
    const float ry = cz * dx - cx * dz;
    const float rz = cx * dy - cy * dx;
    const float u = rx * bx + ry * by + rz * bz;
    const float v = -(rx * ax + ry * ay + rz * az);
    const float sign = slope < 0.0f ? -1.0f : 1.0f;
    const float steep = slope * sign;
    const bool may_meet = (u * sign >= -uv_slack) & (v * sign >= -uv_slack) &
                          ((u + v) * sign <= steep + 2.0f * uv_slack) &
                          (height * sign >= ray.t_low * steep - t_slack) &
                          (height * sign <= ray.t_high * steep + t_slack);
    marks |= may_meet ? 1u << i : 0u;
  }
  return marks;
}

}  // namespace

ARDEE_VECTOR_CLONES
std::uint32_t cull_conservatively(const TriangleBlock& block, const BlockRay& ray) {
  return mark(block, ray);
}

ARDEE_VECTOR_CLONES
std::uint32_t cull_conservatively(const TriangleBlock& block, const BlockPlace& place,
                                  const float center[3], const LocalRay& ray, float slack_m) {
  // The ray starts at its point nearest to the centre: there floats are of the block's size.
  const float* d = ray.direction;
  const float cx = center[0] - ray.origin[0];
  const float cy = center[1] - ray.origin[1];
  const float cz = center[2] - ray.origin[2];
  const float t_near = cx * d[0] + cy * d[1] + cz * d[2];
  const float ox = t_near * d[0] - cx;
  const float oy = t_near * d[1] - cy;
  const float oz = t_near * d[2] - cz;
  BlockRay local;
  for (int k = 0; k < 3; ++k) {
    const float* row = place.m[k];
    local.origin[k] = row[0] * ox + row[1] * oy + row[2] * oz;
    local.direction[k] = row[0] * d[0] + row[1] * d[1] + row[2] * d[2];
  }
  const float t_radius = 2.0f * block.radius * place.scale + 1e-3f;
  const float t_left = ray.t_high - t_near;
  local.t_low = t_near < t_radius ? -t_near : -t_radius;
  local.t_high = t_left < t_radius ? t_left : t_radius;
  local.slack_m = slack_m / place.scale + static_cast<float>(kBlockSlack) * block.radius;
  return mark(block, local);
}

ARDEE_VECTOR_CLONES
void block_bounds(const TriangleBlock& block, const float m[3][3], const float center[3],
                  float lower[3], float upper[3]) {
  for (int k = 0; k < 3; ++k) {
    float low[kBlockLanes];
    float high[kBlockLanes];
    for (int i = 0; i < kBlockLanes; ++i) {
      const float a = m[k][0] * block.vertex[0][i] + m[k][1] * block.vertex[1][i] +
                      m[k][2] * block.vertex[2][i];
      const float b = a + m[k][0] * block.edge1[0][i] + m[k][1] * block.edge1[1][i] +
                      m[k][2] * block.edge1[2][i];
      const float c = a + m[k][0] * block.edge2[0][i] + m[k][1] * block.edge2[1][i] +
                      m[k][2] * block.edge2[2][i];
      const float ab_low = a < b ? a : b;
      const float ab_high = a < b ? b : a;
      low[i] = ab_low < c ? ab_low : c;
      high[i] = ab_high < c ? c : ab_high;
    }
    for (int width = kBlockLanes / 2; width > 0; width /= 2) {
      for (int i = 0; i < width; ++i) {
        low[i] = low[i] < low[i + width] ? low[i] : low[i + width];
        high[i] = high[i] < high[i + width] ? high[i + width] : high[i];
      }
    }
    lower[k] = center[k] + low[0];
    upper[k] = center[k] + high[0];
  }
}

}  // namespace ardee::raycast
