// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ardee_sim/raycast/primary_ray_packet.h"
#include "ardee_sim/render/radiance_cache.h"
#include "ardee_sim/render/shader.h"

namespace ardee::render {

/// Shades hits of primary rays texel by texel: a camera sees most texels again and again, and only
/// texels that are not in the cache are shaded. The next call reuses the memory.
class CachedShading {
 public:
  /// Returns the greatest width of a texel that a pixel sees at a distance of one metre, straight
  /// on.
  static float width_m(const TileShading& shading);

  /// Light found for a request.
  struct Found {
    Eigen::Vector3f light;
    bool met = false;  // false: the request has no texel
  };
  const std::vector<Found>& flush(const TileShading& shading,
                                  const std::vector<raycast::PrimaryRayPacket>& blocks,
                                  const std::vector<raycast::TexelRequest>& requests,
                                  Shader& shader);

 private:
  void find_texels(const TileShading& shading, const std::vector<raycast::PrimaryRayPacket>& blocks,
                   const std::vector<raycast::TexelRequest>& requests, const Shader& shader);
  void shade_missed(const TileShading& shading, Shader& shader);

  std::vector<raycast::SurfaceTexel> texels_;
  std::vector<RadianceCache::CacheKey> names_;
  std::vector<Found> found_;
  std::vector<std::size_t> missed_;  // texels that are not in the cache
};

}  // namespace ardee::render
