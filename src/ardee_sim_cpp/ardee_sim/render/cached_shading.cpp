// SPDX-License-Identifier: MIT
#include "ardee_sim/render/cached_shading.h"

#include <cmath>
#include <cstring>

#include "ardee_sim/core/rng.h"

namespace ardee::render {
namespace {

/// Greatest width of texels in pixels; the least is half of it.
constexpr float kMost_px = 1.5f;

/// Returns a seed of all settings that the light of a triangle scene's texels depends on, beside
/// those of the cache itself.
std::uint64_t seed_of(std::uint64_t draft, const RenderOptions& options) {
  std::uint64_t bits;
  std::memcpy(&bits, &options.max_range_m, sizeof bits);
  return mix_bits(draft ^ mix_bits(bits << 1 | (options.shadows ? 1u : 0u)));
}

RadianceCache::CacheKey name_of(const raycast::SurfaceTexel& texel, std::uint64_t seed) {
  const auto size = static_cast<std::uint16_t>(texel.size);
  const std::uint64_t side = std::uint64_t{texel.triangle} << 32 | std::uint64_t{size} << 1 |
                             (texel.from_behind ? 1u : 0u);
  return {mix_bits(seed ^ side), std::uint64_t{texel.row} * texel.columns + texel.column};
}

}  // namespace

float CachedShading::width_m(const TileShading& shading) {
  return kMost_px / static_cast<float>(shading.camera.focal_length_px());
}

const std::vector<CachedShading::Found>& CachedShading::flush(
    const TileShading& shading, const std::vector<raycast::PrimaryRayPacket>& blocks,
    const std::vector<raycast::TexelRequest>& requests, Shader& shader) {
  find_texels(shading, blocks, requests, shader);
  found_.resize(requests.size());
  missed_.clear();
  for (std::size_t k = 0; k < requests.size(); ++k) {
    found_[k].met = false;
    if (texels_[k].none()) continue;
    RadianceCache::CachedRadiance kept;
    if (shading.store.find(names_[k], kept)) {
      found_[k] = {kept.light, !kept.see_through};
    } else {
      missed_.push_back(k);
    }
  }
  if (!missed_.empty()) shade_missed(shading, shader);
  return found_;
}

void CachedShading::find_texels(const TileShading& shading,
                                const std::vector<raycast::PrimaryRayPacket>& blocks,
                                const std::vector<raycast::TexelRequest>& requests,
                                const Shader& shader) {
  texels_.resize(requests.size());
  names_.resize(requests.size());
  const Eigen::Vector3d& eye_W = shading.camera.X_WC.p;
  const std::uint64_t draft = shading.rays.find_texels(eye_W, blocks.data(), requests.data(),
                                                       requests.size(), texels_.data());
  const std::uint64_t seed = seed_of(draft, shading.options);
  const bool models = shading.rays.has_models();
  for (std::size_t k = 0; k < requests.size(); ++k) {
    if (texels_[k].none()) continue;
    if (models) {
      const raycast::TexelRequest& request = requests[k];
      const raycast::PrimaryRayPacket& block =
          blocks[request.ray / raycast::PrimaryRayPacket::kRays];
      const int i = static_cast<int>(request.ray % raycast::PrimaryRayPacket::kRays);
      const Eigen::Vector3f at_W = eye_W.cast<float>() + request.range_m * block.direction_W(i);
      if (shader.may_be_shaded(at_W, 2.0f * std::abs(request.width_m))) {
        texels_[k] = {};
        continue;
      }
    }
    names_[k] = name_of(texels_[k], seed);
    shading.store.prefetch(names_[k]);
  }
}

void CachedShading::shade_missed(const TileShading& shading, Shader& shader) {
  shader.clear();
  for (const std::size_t k : missed_) {
    shader.enqueue(texels_[k],
                   std::ldexp(M_SQRT2, texels_[k].size) / static_cast<double>(kMost_px));
  }
  shader.flush();
  for (std::size_t i = 0; i < missed_.size(); ++i) {
    const std::size_t k = missed_[i];
    const Sample& sample = shader.samples()[i];
    const RadianceCache::CachedRadiance kept =
        RadianceCache::rounded({sample.light, sample.see_through});
    shading.store.keep(names_[k], kept);
    found_[k] = {kept.light, !kept.see_through};
  }
  shader.clear();
}

}  // namespace ardee::render
