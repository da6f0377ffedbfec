// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ardee_sim/raycast/primary_ray_packet.h"
#include "ardee_sim/render/radiance_cache.h"
#include "ardee_sim/render/shader.h"

namespace ardee::render {

/// The light of what primary rays have hit, texel by texel: a camera sees most texels again and
/// again, and only what is not in the cache is shaded. The room of one call is used for the next.
class CachedShading {
 public:
  /// How wide the texel may be that a pixel sees a metre away, straight on.
  static float width_m(const TileShading& shading);

  /// What is known of a request's light.
  struct Found {
    Eigen::Vector3f light;
    bool met = false;  // else it is not that of a texel
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
