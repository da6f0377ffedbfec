// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/approximate_tracer.h"

#include <algorithm>

namespace ardee::raycast {
namespace {

/// Greatest height of an eye: from higher up, floats would be too coarse.
constexpr double kHighest_m = 1000.0;
/// Least distance of a texel from a local scene's border, because its rays start off the surface.
constexpr double kOffBorder_m = 1e-2;
/// Reach of a finished ray.
constexpr double kDone = -1.0;

}  // namespace

bool ApproximateTracer::starts_at(const Eigen::Vector3d& eye_W) const {
  return local_ != nullptr && local_->triangle_scene() != nullptr && local_->depth_m(eye_W) > 0.0 &&
         std::abs(eye_W.z() - local_->origin_W().z()) <= kHighest_m;
}

bool ApproximateTracer::load(const SceneRay* rays, int count, RayPacket& packet) const {
  for (int i = 0; i < count; ++i) {
    if (!starts_at(rays[i].origin_W)) return false;
    packet.add(i, {rays[i].origin_W - local_->origin_W(), rays[i].direction_W}, rays[i].reach_m);
  }
  return true;
}

const ModelList& ApproximateTracer::others() const {
  return beside_->ask_tree() ? moving_.loose() : beside_->models();
}

bool ApproximateTracer::intersect_others(const SceneRay* rays, int count,
                                         const double reach_m[kPacketRays],
                                         RayQuery::Purpose purpose,
                                         RayQuery queries[kPacketRays]) const {
  double t_high[kPacketRays];
  double t_leave[kPacketRays];
  double t_tree[kPacketRays];
  bool beyond = false;
  bool touched = beside_->ask_tree();
  for (int i = 0; i < kPacketRays; ++i) {
    t_high[i] = kDone;
    t_leave[i] = std::numeric_limits<double>::infinity();
    t_tree[i] = t_leave[i];
    if (i >= count || reach_m[i] < 0.0) continue;
    const Ray ray{rays[i].origin_W, rays[i].direction_W};
    // The straight way to the border is the shortest way out.
    const double depth_m = local_->depth_m(ray.origin);
    const double below_top_m = top_W() - ray.origin.z();
    const bool leaves_above = ray.direction.z() > 0.0 && ray.direction.z() * depth_m >= below_top_m;
    if (reach_m[i] > depth_m && !leaves_above) {
      t_leave[i] = beside_->are_beyond() ? local_->border_t(ray) : local_->exit_t(ray);
    }
    t_high[i] = std::min(reach_m[i], t_leave[i]);
    if (reach_m[i] > t_leave[i]) {
      beyond = true;
    } else {
      t_leave[i] = std::numeric_limits<double>::infinity();
    }
    t_tree[i] = beside_->ask_tree() ? 0.0 : t_leave[i];
    touched = touched || others().touches_any(ray, reach_m[i]);
  }
  if (!beyond && !touched && !local_->has_rest() && !scenery_.has_unbounded()) return false;
  for (int i = 0; i < count; ++i) {
    queries[i].start({rays[i].origin_W, rays[i].direction_W}, reach_m[i], kNoEntity, 0, purpose);
    if (reach_m[i] < 0.0) continue;
    scenery_.intersect_unbounded(queries[i]);
  }
  if (touched) others().intersect(queries, count);
  for (int i = 0; i < count; ++i) t_high[i] = std::min(t_high[i], queries[i].reach());
  local_->intersect_rest(queries, t_high);
  if (beyond) scenery_.places().intersect(queries, t_leave);
  if (beyond || beside_->ask_tree()) moving_.tree().intersect(queries, t_tree);
  return true;
}

double ApproximateTracer::top_W() const {
  return std::max(scenery_.places().bounds_W().upper.z(), moving_.tree().bounds_W().upper.z());
}

bool ApproximateTracer::trace(const SceneRay* rays, int count, SurfaceInteraction* points) const {
  RayPacket packet;
  if (!load(rays, count, packet)) return false;
  const TriangleScene& triangle_scene = *local_->triangle_scene();
  triangle_scene.intersect(packet);
  double reach_m[kPacketRays];
  for (int i = 0; i < count; ++i) {
    const bool met = packet.rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    reach_m[i] = rays[i].reach_m;
    if (met) {
      triangle_scene.fill(
          {(rays[i].origin_W - local_->origin_W()).cast<float>(), rays[i].direction_W.cast<float>(),
           TriangleScene::triangle_of(packet.rays.hit.geomID[i], packet.rays.hit.primID[i])},
          points[i]);
      reach_m[i] = std::min(reach_m[i], points[i].range_m);
    } else {
      points[i] = SurfaceInteraction{};
    }
  }
  RayQuery queries[kPacketRays];
  if (!intersect_others(rays, count, reach_m, RayQuery::Purpose::kNearest, queries)) return true;
  for (int i = 0; i < count; ++i) {
    if (queries[i].has_hit()) queries[i].fill(points[i]);
  }
  return true;
}

bool ApproximateTracer::find_shadows(const SceneRay* rays, int count, bool* in_shadow) const {
  RayPacket packet;
  if (!load(rays, count, packet)) return false;
  local_->triangle_scene()->find_shadows(packet);
  double reach_m[kPacketRays];
  bool doubts = false;
  for (int i = 0; i < count; ++i) {
    in_shadow[i] = packet.rays.ray.tfar[i] < 0.0f;
    reach_m[i] = in_shadow[i] ? kDone : rays[i].reach_m;
    doubts = doubts || !in_shadow[i];
  }
  RayQuery queries[kPacketRays];
  if (!doubts || !intersect_others(rays, count, reach_m, RayQuery::Purpose::kShadow, queries)) {
    return true;
  }
  for (int i = 0; i < count; ++i) in_shadow[i] = in_shadow[i] || queries[i].has_hit();
  return true;
}

void write_exact_hit(const RayHit& hit, std::size_t number, int i, PrimaryRayPacket& block) {
  const bool met = hit.entity != kNoEntity;
  // Two surfaces share a number once in 10^9 pairs; their normals may still differ.
  const std::uint64_t name =
      std::uint64_t{hit.entity} << 32 ^ std::uint64_t{hit.link} << 16 ^ hit.shape;
  const auto mixed = static_cast<std::uint32_t>(name * 0x9E3779B97F4A7C15u >> 33);
  block.surface[i] = met ? PrimaryRayPacket::kOutside | mixed : PrimaryRayPacket::kNothing;
  const std::uint32_t ray =
      static_cast<std::uint32_t>(number) * PrimaryRayPacket::kRays + static_cast<std::uint32_t>(i);
  block.triangle[i] = met ? PrimaryRayPacket::kOutside | ray : 0;
  block.range_m[i] = met ? hit.range_m + block.near_m[i] : std::numeric_limits<float>::infinity();
  const Eigen::Vector3f normal_W = met ? hit.normal_W : Eigen::Vector3f::Zero();
  block.normal_x_W[i] = normal_W.x();
  block.normal_y_W[i] = normal_W.y();
  block.normal_z_W[i] = normal_W.z();
}

void ApproximateTracer::trace_primary_others(const Eigen::Vector3d& eye_W, std::size_t number,
                                             PrimaryRayPacket& block) const {
  for (int first = 0; first < PrimaryRayPacket::kRays; first += kPacketRays) {
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
    if (!intersect_others(rays, kPacketRays, reach_m, RayQuery::Purpose::kNearest, queries))
      continue;
    for (int i = 0; i < kPacketRays; ++i) {
      if (!queries[i].has_hit()) continue;
      RayHit hit;
      queries[i].fill(hit);
      write_exact_hit(hit, number, first + i, block);
    }
  }
}

void ApproximateTracer::trace_primary(const Eigen::Vector3d& eye_W, PrimaryRayPacket* blocks,
                                      std::size_t count) const {
  const Eigen::Vector3f eye = (eye_W - local_->origin_W()).cast<float>();
  const auto depth_m = static_cast<float>(local_->depth_m(eye_W));
  const auto below_top_m = std::max(static_cast<float>(top_W() - eye_W.z()), 1e-6f);
  const bool always = local_->has_rest() || beside_->ask_tree() || scenery_.has_unbounded();
  for (std::size_t number = 0; number < count; ++number) {
    PrimaryRayPacket& block = blocks[number];
    local_->triangle_scene()->trace_primary(eye, block);
    // The straight way to the border is the shortest way out.
    unsigned leave = 0;
    for (int i = 0; i < PrimaryRayPacket::kRays; ++i) {
      const unsigned far = std::min(block.far_m[i], block.range_m[i]) > depth_m;
      const unsigned not_above = block.z_W[i] * depth_m < below_top_m;
      leave |= far & not_above;
    }
    if (always || leave != 0 || others().may_touch_some(eye_W, block)) {
      trace_primary_others(eye_W, number, block);
    }
  }
}

std::uint64_t ApproximateTracer::find_texels(const Eigen::Vector3d& eye_W,
                                             const PrimaryRayPacket* blocks,
                                             const TexelRequest* requests, std::size_t count,
                                             SurfaceTexel* texels) const {
  const TriangleScene& triangle_scene = *local_->triangle_scene();
  const double depth_m = local_->depth_m(eye_W) - kOffBorder_m;
  for (std::size_t k = 0; k < count; ++k) {
    const TexelRequest& request = requests[k];
    texels[k].triangle = SurfaceTexel::kNone;
    if (!(request.range_m > 0.0f) || (request.triangle & PrimaryRayPacket::kOutside) != 0) continue;
    const double width_m = 2.0 * std::abs(static_cast<double>(request.width_m));
    const auto range_m = static_cast<double>(request.range_m);
    if (range_m + width_m > depth_m) {
      const Eigen::Vector3d way_W =
          blocks[request.ray / PrimaryRayPacket::kRays]
              .direction_W(static_cast<int>(request.ray % PrimaryRayPacket::kRays))
              .cast<double>();
      if (local_->depth_m(eye_W + range_m * way_W) < width_m + kOffBorder_m) continue;
    }
    texels[k] = triangle_scene.texel(request);
  }
  return triangle_scene.number();
}

void ApproximateTracer::trace_texel(const SurfaceTexel& texel, SceneRay& ray,
                                    SurfaceInteraction& point) const {
  Eigen::Vector3f at;
  local_->triangle_scene()->fill(texel, at, point);
  point.range_m = 1.0;
  ray.direction_W = -point.normal_W;
  ray.origin_W = local_->origin_W() + at.cast<double>() + point.normal_W;
}

void ApproximateTracer::interpolate_hit(const SceneRay& ray, std::uint32_t triangle,
                                        SurfaceInteraction& point) const {
  local_->triangle_scene()->fill(
      {(ray.origin_W - local_->origin_W()).cast<float>(), ray.direction_W.cast<float>(), triangle},
      point);
}

}  // namespace ardee::raycast
