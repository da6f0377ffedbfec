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

bool QuickLook::load(const SceneRay* rays, int count, RayPacket& packet) const {
  if (region_ == nullptr || region_->draft() == nullptr) return false;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d origin = rays[i].origin_W - region_->origin_W();
    if (region_->depth_m(rays[i].origin_W) <= 0.0 || std::abs(origin.z()) > kHighest_m) {
      return false;
    }
    packet.add(i, {origin, rays[i].direction_W}, rays[i].reach_m);
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
      draft.fill(packet, i, points[i]);
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

}  // namespace ardee
