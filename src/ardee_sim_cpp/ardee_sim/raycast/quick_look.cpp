// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/quick_look.h"

#include <algorithm>

namespace ardee {
namespace {

/// From higher up, floats would be too coarse.
constexpr double kHighest_m = 1000.0;
/// Cells begin so far inside a region, for their rays start off the surface.
constexpr double kOffBorder_m = 1e-2;
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

const ModelList& QuickLook::others() const {
  return region_->asks_tree() ? moving_.loose() : region_->others();
}

bool QuickLook::meet_others(const SceneRay* rays, int count, const double reach_m[kPacketRays],
                            RayQuery::Purpose purpose, RayQuery queries[kPacketRays]) const {
  double t_high[kPacketRays];
  double t_leave[kPacketRays];
  double t_tree[kPacketRays];
  bool beyond = false;
  bool touched = region_->asks_tree();
  for (int i = 0; i < kPacketRays; ++i) {
    t_high[i] = kDone;
    t_leave[i] = std::numeric_limits<double>::infinity();
    t_tree[i] = t_leave[i];
    if (i >= count || reach_m[i] < 0.0) continue;
    const Ray ray{rays[i].origin_W, rays[i].direction_W};
    // No way out is shorter than the one straight to the border.
    const double depth_m = region_->depth_m(ray.origin);
    const double below_top_m = top_W() - ray.origin.z();
    const bool leaves_above = ray.direction.z() > 0.0 && ray.direction.z() * depth_m >= below_top_m;
    if (reach_m[i] > depth_m && !leaves_above) t_leave[i] = region_->picture_exit_t(ray);
    t_high[i] = std::min(reach_m[i], t_leave[i]);
    if (reach_m[i] > t_leave[i]) {
      beyond = true;
    } else {
      t_leave[i] = std::numeric_limits<double>::infinity();
    }
    t_tree[i] = region_->asks_tree() ? 0.0 : t_leave[i];
    touched = touched || others().touches_any(ray, reach_m[i]);
  }
  if (!beyond && !touched && !region_->has_rest() && !scenery_.has_everywhere()) return false;
  for (int i = 0; i < count; ++i) {
    queries[i].start({rays[i].origin_W, rays[i].direction_W}, reach_m[i], kNoEntity, 0, purpose);
    if (reach_m[i] < 0.0) continue;
    scenery_.meet_everywhere(queries[i]);
  }
  if (touched) others().meet(queries, count);
  for (int i = 0; i < count; ++i) t_high[i] = std::min(t_high[i], queries[i].reach());
  region_->meet_rest(queries, t_high);
  if (beyond) scenery_.places().meet(queries, t_leave);
  if (beyond || region_->asks_tree()) moving_.tree().meet(queries, t_tree);
  return true;
}

double QuickLook::top_W() const {
  return std::max(scenery_.places().bounds_W().upper.z(), moving_.tree().bounds_W().upper.z());
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
      draft.fill({(rays[i].origin_W - region_->origin_W()).cast<float>(),
                  rays[i].direction_W.cast<float>(),
                  DraftScene::triangle_of(packet.rays.hit.geomID[i], packet.rays.hit.primID[i])},
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

void see_exactly(const RayHit& hit, std::size_t number, int i, GlanceBlock& block) {
  const bool met = hit.entity != kNoEntity;
  // Two surfaces share a number once in a thousand million pairs; their normals may still differ.
  const std::uint64_t name =
      std::uint64_t{hit.entity} << 32 ^ std::uint64_t{hit.link} << 16 ^ hit.shape;
  const auto mixed = static_cast<std::uint32_t>(name * 0x9E3779B97F4A7C15u >> 33);
  block.surface[i] = met ? GlanceBlock::kOutside | mixed : GlanceBlock::kNothing;
  const std::uint32_t ray =
      static_cast<std::uint32_t>(number) * GlanceBlock::kRays + static_cast<std::uint32_t>(i);
  block.triangle[i] = met ? GlanceBlock::kOutside | ray : 0;
  block.range_m[i] = met ? hit.range_m + block.near_m[i] : std::numeric_limits<float>::infinity();
  const Eigen::Vector3f normal_W = met ? hit.normal_W : Eigen::Vector3f::Zero();
  block.normal_x_W[i] = normal_W.x();
  block.normal_y_W[i] = normal_W.y();
  block.normal_z_W[i] = normal_W.z();
}

void QuickLook::glance_at_others(const Eigen::Vector3d& eye_W, std::size_t number,
                                 GlanceBlock& block) const {
  for (int first = 0; first < GlanceBlock::kRays; first += kPacketRays) {
    SceneRay rays[kPacketRays];
    double reach_m[kPacketRays];
    for (int i = 0; i < kPacketRays; ++i) {
      const int k = first + i;
      const Eigen::Vector3d way_W = block.direction_W(k).cast<double>();
      const auto near_m = static_cast<double>(block.near_m[k]);
      reach_m[i] = static_cast<double>(std::min(block.far_m[k], block.range_m[k])) - near_m;
      rays[i] = {eye_W + near_m * way_W, way_W, reach_m[i]};
    }
    RayQuery queries[kPacketRays];
    if (!meet_others(rays, kPacketRays, reach_m, RayQuery::Purpose::kNearest, queries)) continue;
    for (int i = 0; i < kPacketRays; ++i) {
      if (!queries[i].has_hit()) continue;
      RayHit hit;
      queries[i].fill(hit);
      see_exactly(hit, number, first + i, block);
    }
  }
}

void QuickLook::glance(const Eigen::Vector3d& eye_W, GlanceBlock* blocks, std::size_t count) const {
  const Eigen::Vector3f eye = (eye_W - region_->origin_W()).cast<float>();
  const auto depth_m = static_cast<float>(region_->depth_m(eye_W));
  const auto below_top_m = std::max(static_cast<float>(top_W() - eye_W.z()), 1e-6f);
  const bool always = region_->has_rest() || region_->asks_tree() || scenery_.has_everywhere();
  for (std::size_t number = 0; number < count; ++number) {
    GlanceBlock& block = blocks[number];
    region_->draft()->glance(eye, block);
    // No way out is shorter than the one straight to the border.
    unsigned leave = 0;
    for (int i = 0; i < GlanceBlock::kRays; ++i) {
      const unsigned far = std::min(block.far_m[i], block.range_m[i]) > depth_m;
      const unsigned not_above = block.z_W[i] * depth_m < below_top_m;
      leave |= far & not_above;
    }
    if (always || leave != 0 || others().may_touch_some(eye_W, block)) {
      glance_at_others(eye_W, number, block);
    }
  }
}

std::uint64_t QuickLook::find_cells(const Eigen::Vector3d& eye_W, const GlanceBlock* blocks,
                                    const CellRequest* requests, std::size_t count,
                                    SurfaceCell* cells) const {
  const DraftScene& draft = *region_->draft();
  const double depth_m = region_->depth_m(eye_W) - kOffBorder_m;
  for (std::size_t k = 0; k < count; ++k) {
    const CellRequest& request = requests[k];
    cells[k].triangle = SurfaceCell::kNone;
    if (!(request.range_m > 0.0f) || (request.triangle & GlanceBlock::kOutside) != 0) continue;
    const double width_m = 2.0 * std::abs(static_cast<double>(request.width_m));
    const auto range_m = static_cast<double>(request.range_m);
    if (range_m + width_m > depth_m) {
      const Eigen::Vector3d way_W =
          blocks[request.ray / GlanceBlock::kRays]
              .direction_W(static_cast<int>(request.ray % GlanceBlock::kRays))
              .cast<double>();
      if (region_->depth_m(eye_W + range_m * way_W) < width_m + kOffBorder_m) continue;
    }
    cells[k] = draft.cell(request);
  }
  return draft.number();
}

void QuickLook::look_at(const SurfaceCell& cell, SceneRay& ray, SurfacePoint& point) const {
  Eigen::Vector3f at;
  region_->draft()->fill(cell, at, point);
  point.range_m = 1.0;
  ray.direction_W = -point.normal_W;
  ray.origin_W = region_->origin_W() + at.cast<double>() + point.normal_W;
}

void QuickLook::look_closer(const SceneRay& ray, std::uint32_t triangle,
                            SurfacePoint& point) const {
  region_->draft()->fill(
      {(ray.origin_W - region_->origin_W()).cast<float>(), ray.direction_W.cast<float>(), triangle},
      point);
}

}  // namespace ardee
