// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/quick_look.h"

#include <algorithm>

namespace ardee {
namespace {

/// From higher up, floats would be too coarse.
constexpr double kHighest_m = 1000.0;
/// Of a ray that needs nothing more.
constexpr double kDone = -1.0;

}  // namespace

bool QuickLook::starts_at(const Eigen::Vector3d& eye_W) const {
  return region_ != nullptr && region_->draft() != nullptr && region_->depth_m(eye_W) > 0.0 &&
         std::abs(eye_W.z() - region_->origin_W().z()) <= kHighest_m;
}

bool QuickLook::load(const SceneRay* rays, int count, RayPacket& packet) const {
  for (int i = 0; i < count; ++i) {
    if (!starts_at(rays[i].origin_W)) return false;
    packet.add(i, {rays[i].origin_W - region_->origin_W(), rays[i].direction_W}, rays[i].reach_m);
  }
  return true;
}

bool QuickLook::meet_others(const SceneRay* rays, int count, const double reach_m[kPacketRays],
                            RayQuery::Purpose purpose, RayQuery queries[kPacketRays]) const {
  double t_high[kPacketRays];
  double t_leave[kPacketRays];
  bool beyond = false;
  bool touched = false;
  for (int i = 0; i < kPacketRays; ++i) {
    t_high[i] = kDone;
    t_leave[i] = std::numeric_limits<double>::infinity();
    if (i >= count || reach_m[i] < 0.0) continue;
    const Ray ray{rays[i].origin_W, rays[i].direction_W};
    // No way out is shorter than the one straight to the border.
    if (reach_m[i] > region_->depth_m(ray.origin)) t_leave[i] = region_->exit_t(ray);
    t_high[i] = std::min(reach_m[i], t_leave[i]);
    if (reach_m[i] > t_leave[i]) {
      beyond = true;
    } else {
      t_leave[i] = std::numeric_limits<double>::infinity();
    }
    touched = touched || moving_.touches_any(ray, reach_m[i]);
  }
  if (!beyond && !touched && !region_->has_rest() && !scenery_.has_everywhere()) return false;
  for (int i = 0; i < count; ++i) {
    queries[i].start({rays[i].origin_W, rays[i].direction_W}, reach_m[i], kNoEntity, 0, purpose);
    if (reach_m[i] < 0.0) continue;
    scenery_.meet_everywhere(queries[i]);
    if (touched) moving_.meet(queries[i]);
    t_high[i] = std::min(t_high[i], queries[i].reach());
  }
  region_->meet_rest(queries, t_high);
  if (beyond) scenery_.meet_places(queries, t_leave);
  return true;
}

bool QuickLook::look(const SceneRay* rays, int count, SurfacePoint* points) const {
  RayPacket packet;
  if (!load(rays, count, packet)) return false;
  const DraftScene& draft = *region_->draft();
  draft.meet(packet);
  double reach_m[kPacketRays];
  for (int i = 0; i < count; ++i) {
    const bool met = packet.rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    reach_m[i] = rays[i].reach_m;
    if (met) {
      draft.fill(
          {(rays[i].origin_W - region_->origin_W()).cast<float>(),
           rays[i].direction_W.cast<float>(), packet.rays.hit.geomID[i], packet.rays.hit.primID[i]},
          points[i]);
      reach_m[i] = std::min(reach_m[i], points[i].range_m);
    } else {
      points[i] = SurfacePoint{};
    }
  }
  RayQuery queries[kPacketRays];
  if (!meet_others(rays, count, reach_m, RayQuery::Purpose::kNearest, queries)) return true;
  for (int i = 0; i < count; ++i) {
    if (queries[i].has_hit()) queries[i].fill(points[i]);
  }
  return true;
}

bool QuickLook::find_shadows(const SceneRay* rays, int count, bool* in_shadow) const {
  RayPacket packet;
  if (!load(rays, count, packet)) return false;
  region_->draft()->find_shadows(packet);
  double reach_m[kPacketRays];
  bool doubts = false;
  for (int i = 0; i < count; ++i) {
    in_shadow[i] = packet.rays.ray.tfar[i] < 0.0f;
    reach_m[i] = in_shadow[i] ? kDone : rays[i].reach_m;
    doubts = doubts || !in_shadow[i];
  }
  RayQuery queries[kPacketRays];
  if (!doubts || !meet_others(rays, count, reach_m, RayQuery::Purpose::kShadow, queries)) {
    return true;
  }
  for (int i = 0; i < count; ++i) in_shadow[i] = in_shadow[i] || queries[i].has_hit();
  return true;
}

Glance glance_of(const RayHit& hit) {
  Glance glance;
  if (hit.entity == kNoEntity) return glance;
  // Apart from the surfaces of a draft by the highest bit.
  glance.surface = std::uint64_t{1} << 63 | std::uint64_t{hit.entity} << 31 |
                   std::uint64_t{hit.link & 0xFFFFu} << 15 | (hit.shape & 0x7FFFu);
  glance.range_m = hit.range_m;
  glance.normal_W = hit.normal_W;
  return glance;
}

void QuickLook::glance_at_others(const Eigen::Vector3d& eye_W, const GlanceRay* rays, int count,
                                 Glance* glances) const {
  SceneRay scene_rays[kPacketRays];
  double reach_m[kPacketRays];
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d way_W = rays[i].direction_W.cast<double>();
    const auto near_m = static_cast<double>(rays[i].near_m);
    reach_m[i] = static_cast<double>(std::min(rays[i].far_m, glances[i].range_m)) - near_m;
    scene_rays[i] = {eye_W + near_m * way_W, way_W, reach_m[i]};
  }
  RayQuery queries[kPacketRays];
  if (!meet_others(scene_rays, count, reach_m, RayQuery::Purpose::kNearest, queries)) return;
  for (int i = 0; i < count; ++i) {
    if (!queries[i].has_hit()) continue;
    RayHit hit;
    queries[i].fill(hit);
    glances[i] = glance_of(hit);
    glances[i].range_m += rays[i].near_m;
  }
}

void QuickLook::glance(const Eigen::Vector3d& eye_W, const GlanceRay* rays, std::size_t count,
                       Glance* glances) const {
  constexpr std::size_t kTogether = 16;
  const Eigen::Vector3f eye = (eye_W - region_->origin_W()).cast<float>();
  const double depth_m = region_->depth_m(eye_W);
  const double below_top_m = scenery_.bounds_W().upper.z() - eye_W.z();
  const bool always = region_->has_rest() || scenery_.has_everywhere();
  for (std::size_t first = 0; first < count; first += kTogether) {
    const int block = static_cast<int>(std::min(kTogether, count - first));
    region_->draft()->glance(eye, rays + first, block, glances + first);
    bool others = always || moving_.may_touch_some(eye_W, rays + first, block);
    for (int i = 0; i < block && !others; ++i) {
      const std::size_t k = first + static_cast<std::size_t>(i);
      // No way out is shorter than the one straight to the border.
      const auto reach_m = static_cast<double>(std::min(rays[k].far_m, glances[k].range_m));
      const auto climb = static_cast<double>(rays[k].direction_W.z());
      others = reach_m > depth_m && (climb <= 0.0 || climb * depth_m < below_top_m);
    }
    for (int half = 0; half < block && others; half += kPacketRays) {
      const std::size_t from = first + static_cast<std::size_t>(half);
      glance_at_others(eye_W, rays + from, std::min(kPacketRays, block - half), glances + from);
    }
  }
}

void QuickLook::look_closer(const SceneRay& ray, const Glance& glance, SurfacePoint& point) const {
  region_->draft()->fill({(ray.origin_W - region_->origin_W()).cast<float>(),
                          ray.direction_W.cast<float>(), glance.geometry, glance.primitive},
                         point);
}

}  // namespace ardee
