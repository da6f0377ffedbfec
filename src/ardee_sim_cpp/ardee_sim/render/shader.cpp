// SPDX-License-Identifier: MIT
#include "ardee_sim/render/shader.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ardee_sim/render/sky.h"

namespace ardee::render {
namespace {

/// Distance of a new ray's start from the surface that it leaves.
constexpr double kOffset_m = 1e-4;
/// Greatest number of surfaces along a ray that are shaded; the last counts as opaque.
constexpr int kMaxLayers = 8;
constexpr float kOpaque = 0.999f;
/// Number of samples that are shaded together: their data fit into the fastest memory.
constexpr std::size_t kAtOnce = 64;

/// Share of the light on the far side of a two-sided sheet that comes through, as a fraction of
/// what it would reflect on the near side: leaves transmit less visible light than they reflect.
constexpr double kSheetTransmission = 0.4;

/// Returns whether a two-sided mesh counts as a sheet, such as a leaf. In a closed mesh, the far
/// wall keeps the light out.
bool is_sheet(const raycast::SurfaceInteraction& point) {
  return point.two_sided && point.visual != nullptr &&
         std::holds_alternative<Mesh>(point.visual->geometry);
}

/// Returns the bit of a lamp; 0 beyond the first 32.
std::uint32_t bit_of(std::size_t lamp) { return lamp < 32 ? 1u << lamp : 0u; }

}  // namespace

void Shader::begin(const TileShading& shading) {
  s_ = &shading;
  R_WC_ = shading.camera.X_WC.q.toRotationMatrix();
  focal_px_ = shading.camera.focal_length_px();
  pixel_rad_ = 1.0 / (focal_px_ * std::sqrt(static_cast<double>(shading.options.samples)));
  distant_.clear();
  for (const Light& light : shading.lights) {
    const bool distant = light.type == Light::Type::kDirectional;
    distant_.push_back(distant ? illuminate(light, Eigen::Vector3d::Zero()) : std::nullopt);
  }
  lookup_cache_ = {};
  clear();
}

void Shader::clear() {
  samples_.clear();
  rays_.clear();
  owners_.clear();
  triangles_.clear();
  texels_.clear();
}

void Shader::enqueue(const raycast::PrimaryRayPacket& glances, int ray,
                     const LampKnowledge& lamps) {
  Sample& sample = samples_.emplace_back();
  const Eigen::Vector3d direction_W = glances.direction_W(ray).cast<double>();
  if (!glances.met(ray)) {
    sample.light = s_->sky.color(direction_W);
    return;
  }
  sample.travelled_m = static_cast<double>(glances.near_m[ray]);
  sample.lamps = lamps;
  rays_.push_back({s_->camera.X_WC.p + sample.travelled_m * direction_W, direction_W,
                   static_cast<double>(glances.far_m[ray]) - sample.travelled_m});
  owners_.push_back(static_cast<std::uint32_t>(samples_.size() - 1));
  triangles_.push_back(glances.triangle[ray]);
}

void Shader::enqueue(double x_px, double y_px) {
  Sample& sample = samples_.emplace_back();
  const Eigen::Vector3d way_C = s_->camera.direction_C(x_px, y_px, focal_px_);
  const double stretch = way_C.norm();
  if (!(stretch < std::numeric_limits<double>::infinity())) return;
  const Eigen::Vector3d direction_W = R_WC_ * (way_C * (1.0 / stretch));
  sample.travelled_m = s_->camera.near_m * stretch;
  sample.stretch = stretch;
  const double end_m = std::min(s_->camera.far_m * stretch, s_->options.max_range_m);
  rays_.push_back({s_->camera.X_WC.p + sample.travelled_m * direction_W, direction_W,
                   end_m - sample.travelled_m});
  owners_.push_back(static_cast<std::uint32_t>(samples_.size() - 1));
}

void Shader::enqueue(const raycast::SurfaceTexel& texel, double footprint_m) {
  samples_.emplace_back().footprint_m = footprint_m;
  rays_.emplace_back();
  owners_.push_back(static_cast<std::uint32_t>(samples_.size() - 1));
  texels_.push_back(texel);
}

bool Shader::may_be_shaded(const Eigen::Vector3f& at_W, float about_m) const {
  for (std::size_t lamp = 0; lamp < s_->lights.size(); ++lamp) {
    const Light& light = s_->lights[lamp];
    if (!light.cast_shadows) continue;
    Eigen::Vector3f to_lamp_W;
    if (light.type != Light::Type::kDirectional) {
      to_lamp_W = (light.pose.p - at_W.cast<double>()).normalized().cast<float>();
    } else if (distant_[lamp]) {
      to_lamp_W = distant_[lamp]->to_light_W.cast<float>();
    } else {
      continue;
    }
    if (s_->rays.may_be_shaded(s_->camera.X_WC.p, at_W, to_lamp_W, about_m)) return true;
  }
  return false;
}

void Shader::flush() {
  points_.resize(kAtOnce);
  for (int layer = 0; layer < kMaxLayers && !rays_.empty(); ++layer) {
    const bool glanced = layer == 0 && !triangles_.empty();
    for (std::size_t begin = 0; begin < rays_.size(); begin += kAtOnce) {
      const std::size_t count = std::min(kAtOnce, rays_.size() - begin);
      find_points(begin, count, glanced);
      for (std::size_t k = 0; k < count; ++k) shade(points_[k], begin + k, layer);
    }
    add_unshadowed();
    rays_.swap(next_rays_);
    owners_.swap(next_owners_);
    next_rays_.clear();
    next_owners_.clear();
  }
}

void Shader::find_points(std::size_t begin, std::size_t count, bool glanced) {
  const raycast::SceneRay* rays = rays_.data() + begin;
  if (!texels_.empty()) {
    s_->rays.trace_texels(s_->camera.X_WC.p, texels_.data() + begin, count, rays_.data() + begin,
                          points_.data());
  } else if (glanced) {
    s_->rays.interpolate_hits(s_->camera.X_WC.p, rays, triangles_.data() + begin, count,
                              points_.data());
  } else if (s_->options.approximate) {
    s_->rays.trace_approximately(rays, count, points_.data());
  } else {
    s_->rays.trace(rays, count, points_.data());
  }
}

void Shader::shade(const raycast::SurfaceInteraction& point, std::size_t i, int layer) {
  Sample& sample = samples_[owners_[i]];
  const raycast::SceneRay& ray = rays_[i];
  if (!point.met()) {
    sample.light += sample.transmittance * s_->sky.color(ray.direction_W);
    return;
  }
  sample.travelled_m += point.range_m;
  const bool of_texel = !texels_.empty();
  const double slant = std::max(std::abs(point.smooth_normal_W.dot(ray.direction_W)), kLeastSlant);
  const double footprint_m =
      of_texel ? sample.footprint_m : sample.travelled_m * pixel_rad_ / std::sqrt(slant);
  const SurfaceColor look = s_->materials.at(point, footprint_m, lookup_cache_);
  const bool last = layer + 1 == kMaxLayers;
  const float opacity = last || look.opacity > kOpaque ? 1.0f : look.opacity;
  sample.see_through = of_texel && opacity < 1.0f;
  if (sample.see_through) return;
  const Eigen::Vector3d at_W = ray.origin_W + point.range_m * ray.direction_W;
  const float share = sample.transmittance * opacity;
  Eigen::Vector3f ambient = s_->sky.ambient(point.smooth_normal_W);
  if (is_sheet(point)) {
    ambient += static_cast<float>(kSheetTransmission) * s_->sky.ambient(-point.smooth_normal_W);
  }
  sample.light += share * (look.emissive + look.ambient.cwiseProduct(ambient));
  for (std::size_t k = 0; k < s_->lights.size(); ++k) {
    enqueue_shadow_ray(k, at_W, point, share * look.diffuse, i, layer == 0);
  }
  sample.transmittance *= 1.0f - opacity;
  if (opacity < 1.0f) continue_ray(at_W - kOffset_m * point.normal_W, point.range_m, i);
}

void Shader::continue_ray(const Eigen::Vector3d& from_W, double range_m, std::size_t i) {
  const raycast::SceneRay& ray = rays_[i];
  next_rays_.push_back({from_W, ray.direction_W, ray.reach_m - range_m});
  next_owners_.push_back(owners_[i]);
}

void Shader::enqueue_shadow_ray(std::size_t lamp, const Eigen::Vector3d& at_W,
                                const raycast::SurfaceInteraction& point,
                                const Eigen::Vector3f& diffuse, std::size_t i, bool first) {
  const Light& light = s_->lights[lamp];
  const bool distant = light.type == Light::Type::kDirectional;
  const std::optional<Illumination> of_place = distant ? std::nullopt : illuminate(light, at_W);
  const std::optional<Illumination>& found = distant ? distant_[lamp] : of_place;
  if (!found) return;
  double cosine = point.smooth_normal_W.dot(found->to_light_W);
  Eigen::Vector3d lit_side_W = point.normal_W;
  const bool lit_from_behind = cosine <= 0.0;
  if (lit_from_behind) {
    if (!is_sheet(point)) return;
    cosine *= -kSheetTransmission;
    lit_side_W = -lit_side_W;
  }
  if (lit_side_W.dot(found->to_light_W) <= 0.0) return;
  const Eigen::Vector3f arriving = static_cast<float>(cosine) * diffuse.cwiseProduct(found->color);
  const bool shadows = s_->options.shadows && s_->scene.shadows && light.cast_shadows;
  const std::uint32_t lamp_bit = first ? bit_of(lamp) : 0u;
  Sample& sample = samples_[owners_[i]];
  const bool is_known = !shadows || (sample.lamps.known & lamp_bit) != 0;
  if (is_known) {
    if (!shadows || (sample.lamps.in_shadow & lamp_bit) == 0) sample.light += arriving;
    return;
  }
  const double reach_m = std::min(found->distance_m, s_->options.max_range_m);
  shadow_rays_.push_back({at_W + kOffset_m * lit_side_W, found->to_light_W, reach_m - kOffset_m});
  waiting_.push_back({owners_[i], arriving, lamp_bit});
}

void Shader::add_unshadowed() {
  if (room_for_shadows_ < shadow_rays_.size()) {
    room_for_shadows_ = shadow_rays_.size();
    in_shadow_ = std::make_unique<bool[]>(room_for_shadows_);
  }
  if (!texels_.empty()) {
    s_->rays.find_shadows_of_texels(s_->camera.X_WC.p, shadow_rays_.data(), shadow_rays_.size(),
                                    in_shadow_.get());
  } else if (s_->options.approximate) {
    s_->rays.find_shadows_approximately(shadow_rays_.data(), shadow_rays_.size(), in_shadow_.get());
  } else {
    s_->rays.find_shadows(shadow_rays_.data(), shadow_rays_.size(), in_shadow_.get());
  }
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    const Waiting& each = waiting_[i];
    Sample& sample = samples_[each.sample];
    sample.lamps.known |= each.lamp_bit;
    if (in_shadow_[i]) {
      sample.lamps.in_shadow |= each.lamp_bit;
    } else {
      sample.light += each.light;
    }
  }
  shadow_rays_.clear();
  waiting_.clear();
}

}  // namespace ardee::render
