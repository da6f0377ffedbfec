// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/ray_scene.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "ardee_sim/raycast/approximate_tracer.h"
#include "ardee_sim/raycast/local_scene_cache.h"
#include "ardee_sim/raycast/moving_models.h"

namespace ardee::raycast {
namespace {

/// Rays taken at once by a thread: tens of microseconds of work.
constexpr std::size_t kGrain = 64;

}  // namespace

struct RayScene::Impl {
  Impl(SceneKind scene_kind, const RayOptions& ray_options, Log scene_log)
      : masks(std::move(scene_log)),
        scenery(device, masks, scene_kind),
        moving(device, masks, scene_kind),
        local_scenes(device, scenery, moving, ray_options),
        arena(ray_options.threads > 0 ? ray_options.threads : tbb::task_arena::automatic) {
    // TBB has no more workers than cores unless it is told.
    if (ray_options.threads > tbb::info::default_concurrency()) {
      workers =
          std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                static_cast<std::size_t>(ray_options.threads));
    }
  }

  /// What has boxes is asked in packets; within the local scene first, and beyond it only for rays
  /// that leave it unhindered.
  void cast(RayQuery queries[kPacketRays], int count, const LocalScene* local) const {
    double t_leave[kPacketRays];
    double t_high[kPacketRays];
    double t_low[kPacketRays];
    for (int i = 0; i < count; ++i) scenery.intersect_unbounded(queries[i]);
    moving.intersect(queries, count);
    for (int i = 0; i < kPacketRays; ++i) {
      t_low[i] = std::numeric_limits<double>::infinity();
      t_high[i] = -1.0;
      if (i >= count) continue;
      t_leave[i] = local != nullptr ? local->exit_t(queries[i].ray_W()) : 0.0;
      t_high[i] = std::min(queries[i].reach(), t_leave[i]);
    }
    if (local != nullptr) local->intersect(queries, t_high);
    bool onwards = false;
    for (int i = 0; i < count; ++i) {
      if (local != nullptr && queries[i].reach() <= t_leave[i]) continue;
      t_low[i] = t_leave[i];
      onwards = true;
    }
    if (onwards) scenery.places().intersect(queries, t_low);
  }

  /// Rays of any origins, up to kPacketRays.
  void cast_packet(const SceneRay* rays, int count, RayQuery::Purpose purpose,
                   std::uint32_t own_entity, std::uint32_t own_link,
                   RayQuery queries[kPacketRays]) const {
    const LocalScene* local = local_scenes.find(rays[0].origin_W);
    for (int k = 0; k < count; ++k) {
      const SceneRay& ray = rays[k];
      queries[k].start({ray.origin_W, ray.direction_W}, ray.reach_m, own_entity, own_link, purpose);
      if (local != nullptr && local->depth_m(ray.origin_W) <= 0.0) local = nullptr;
    }
    cast(queries, count, local);
  }

  /// The same for any number of them, by the caller's thread. `quickly(first, count)` says whether
  /// it has done a packet itself.
  template <typename Quickly, typename Take>
  void cast(const SceneRay* rays, std::size_t count, RayQuery::Purpose purpose, Quickly quickly,
            Take take) const {
    require_committed();
    for (std::size_t first = 0; first < count; first += kPacketRays) {
      const int packet = static_cast<int>(std::min<std::size_t>(kPacketRays, count - first));
      if (quickly(first, packet)) continue;
      RayQuery queries[kPacketRays];
      cast_packet(rays + first, packet, purpose, kNoEntity, 0, queries);
      for (int k = 0; k < packet; ++k) take(queries[k], first + static_cast<std::size_t>(k));
    }
  }

  ApproximateTracer approximate_tracer(const SceneRay* rays, std::size_t count) const {
    return {count > 0 ? local_scenes.find(rays[0].origin_W) : nullptr, scenery, moving};
  }
  ApproximateTracer approximate_tracer(const Eigen::Vector3d& eye_W) const {
    return {local_scenes.find(eye_W), scenery, moving};
  }

  void find_shadows(const ApproximateTracer& quick, const SceneRay* rays, std::size_t count,
                    bool* in_shadow) const {
    cast(
        rays, count, RayQuery::Purpose::kShadow,
        [&](std::size_t first, int packet) {
          return quick.find_shadows(rays + first, packet, in_shadow + first);
        },
        [in_shadow](const RayQuery& query, std::size_t i) { in_shadow[i] = query.has_hit(); });
  }

  /// Calls cast_some(first, count, queries) for packets of rays by all threads, and keeps what they
  /// met.
  template <typename CastSome>
  void cast_in_parallel(std::size_t rays, std::vector<RayHit>& hits, CastSome cast_some) const {
    require_committed();
    hits.resize(rays);
    arena.execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays, kGrain),
                        [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i < range.end(); i += kPacketRays) {
                            const int count = static_cast<int>(
                                std::min<std::size_t>(kPacketRays, range.end() - i));
                            RayQuery queries[kPacketRays];
                            cast_some(i, count, queries);
                            for (int k = 0; k < count; ++k)
                              queries[k].fill(hits[i + static_cast<std::size_t>(k)]);
                          }
                        });
    });
  }

  void require_committed() const {
    if (!scenery.committed()) throw Error("ray scene: prepare() must follow a change of scenery");
  }

  EmbreeDevice device;
  AlphaMasks masks;
  SceneryStore scenery;
  MovingModels moving;
  LocalSceneCache local_scenes;
  std::unique_ptr<tbb::global_control> workers;
  mutable tbb::task_arena arena;
};

RayScene::RayScene(SceneKind kind, const RayOptions& options, Log log)
    : impl_(std::make_unique<Impl>(kind, options, std::move(log))) {}

RayScene::~RayScene() = default;

void RayScene::add_scenery(std::uint32_t first_entity, const std::vector<Placement>& placements) {
  impl_->local_scenes.clear();
  impl_->scenery.add(first_entity, placements);
}

void RayScene::remove_scenery(std::uint32_t first_entity) {
  impl_->local_scenes.clear();
  impl_->scenery.remove(first_entity);
}

void RayScene::add_model(std::uint32_t entity, std::shared_ptr<const Model> model) {
  impl_->moving.add(entity, std::move(model));
}

void RayScene::remove_model(std::uint32_t entity) { impl_->moving.remove(entity); }

void RayScene::set_link_poses(std::uint32_t entity, const std::vector<Pose>& X_WL) {
  impl_->moving.set_link_poses(entity, X_WL);
}

void RayScene::prepare(const std::vector<Eigen::Vector3d>& eyes_W, bool pictures) {
  for (const Eigen::Vector3d& eye : eyes_W) {
    if (!eye.allFinite()) throw Error("ray scene: a sensor's position is not finite");
  }
  if (!impl_->scenery.committed()) impl_->scenery.commit();
  impl_->moving.prepare();
  impl_->local_scenes.prepare(eyes_W, pictures);
}

namespace {

void require_sane(const Pose& X_WS, const RayPattern& pattern, float max_range_m) {
  if (!X_WS.is_finite()) throw Error("ray scene: the sensor's pose is not finite");
  if (!(max_range_m >= 0.0f)) throw Error("ray scene: the maximum range must be 0 m or more");
  for (const Eigen::Vector3f& direction : pattern.directions_S) {
    const float square = direction.squaredNorm();
    if (!(std::abs(square - 1.0f) < 1e-3f)) {
      throw Error("ray scene: directions must be finite and of length 1");
    }
  }
}

void require_sane(const std::vector<SceneRay>& rays) {
  for (const SceneRay& ray : rays) {
    const double square = ray.direction_W.squaredNorm();
    if (!ray.origin_W.allFinite() || !(std::abs(square - 1.0) < 1e-3) || !(ray.reach_m >= 0.0)) {
      throw Error("ray scene: rays must be finite, of length 1 and of reach 0 m or more");
    }
  }
}

}  // namespace

void RayScene::cast(const Pose& X_WS, const RayPattern& pattern, float max_range_m,
                    std::uint32_t own_entity, std::uint32_t own_link,
                    std::vector<RayHit>& hits) const {
  require_sane(X_WS, pattern, max_range_m);
  const LocalScene* local = impl_->local_scenes.find(X_WS.p);
  const Eigen::Matrix3d R_WS = X_WS.q.normalized().toRotationMatrix();
  const auto cast_some = [&](std::size_t first, int count, RayQuery* queries) {
    for (int k = 0; k < count; ++k) {
      const Eigen::Vector3f& direction_S =
          pattern.directions_S[first + static_cast<std::size_t>(k)];
      const Eigen::Vector3d direction = (R_WS * direction_S.cast<double>()).normalized();
      queries[k].start({X_WS.p, direction}, static_cast<double>(max_range_m), own_entity, own_link);
    }
    impl_->cast(queries, count, local);
  };
  impl_->cast_in_parallel(pattern.directions_S.size(), hits, cast_some);
}

void RayScene::cast(const std::vector<SceneRay>& rays, std::uint32_t own_entity,
                    std::uint32_t own_link, std::vector<RayHit>& hits) const {
  require_sane(rays);
  impl_->cast_in_parallel(rays.size(), hits, [&](std::size_t first, int count, RayQuery* queries) {
    impl_->cast_packet(rays.data() + first, count, RayQuery::Purpose::kNearest, own_entity,
                       own_link, queries);
  });
}

void RayScene::cast_at_model(const std::vector<SceneRay>& rays, std::uint32_t entity,
                             std::uint32_t own_link, std::vector<RayHit>& hits) const {
  require_sane(rays);
  impl_->cast_in_parallel(rays.size(), hits, [&](std::size_t first, int count, RayQuery* queries) {
    for (int k = 0; k < count; ++k) {
      const SceneRay& ray = rays[first + static_cast<std::size_t>(k)];
      queries[k].start({ray.origin_W, ray.direction_W}, ray.reach_m, entity, own_link);
      impl_->moving.intersect(queries[k], entity);
    }
  });
}

namespace {

constexpr auto kNeverQuickly = [](std::size_t, int) { return false; };

}  // namespace

void RayScene::trace(const SceneRay* rays, std::size_t count, SurfaceInteraction* points) const {
  impl_->cast(rays, count, RayQuery::Purpose::kNearest, kNeverQuickly,
              [points](const RayQuery& query, std::size_t i) { query.fill(points[i]); });
}

void RayScene::intersect(const SceneRay* rays, std::size_t count, RayHit* hits) const {
  impl_->cast(rays, count, RayQuery::Purpose::kNearest, kNeverQuickly,
              [hits](const RayQuery& query, std::size_t i) { query.fill(hits[i]); });
}

void RayScene::find_shadows(const SceneRay* rays, std::size_t count, bool* in_shadow) const {
  impl_->cast(
      rays, count, RayQuery::Purpose::kShadow, kNeverQuickly,
      [in_shadow](const RayQuery& query, std::size_t i) { in_shadow[i] = query.has_hit(); });
}

void RayScene::trace_approximately(const SceneRay* rays, std::size_t count,
                                   SurfaceInteraction* points) const {
  const ApproximateTracer quick = impl_->approximate_tracer(rays, count);
  impl_->cast(
      rays, count, RayQuery::Purpose::kNearest,
      [&](std::size_t first, int packet) {
        return quick.trace(rays + first, packet, points + first);
      },
      [points](const RayQuery& query, std::size_t i) { query.fill(points[i]); });
}

void RayScene::find_shadows_approximately(const SceneRay* rays, std::size_t count,
                                          bool* in_shadow) const {
  impl_->find_shadows(impl_->approximate_tracer(rays, count), rays, count, in_shadow);
}

void RayScene::trace_primary(const Eigen::Vector3d& eye_W, PrimaryRayPacket* blocks,
                             std::size_t count) const {
  impl_->require_committed();
  const ApproximateTracer quick = impl_->approximate_tracer(eye_W);
  if (quick.starts_at(eye_W)) return quick.trace_primary(eye_W, blocks, count);
  for (std::size_t k = 0; k < count; ++k) {
    PrimaryRayPacket& block = blocks[k];
    SceneRay rays[PrimaryRayPacket::kRays];
    RayHit hits[PrimaryRayPacket::kRays];
    for (int i = 0; i < PrimaryRayPacket::kRays; ++i) {
      const Eigen::Vector3d way_W = block.direction_W(i).cast<double>();
      const auto near_m = static_cast<double>(block.near_m[i]);
      rays[i] = {eye_W + near_m * way_W, way_W, static_cast<double>(block.far_m[i]) - near_m};
    }
    intersect(rays, PrimaryRayPacket::kRays, hits);
    for (int i = 0; i < PrimaryRayPacket::kRays; ++i) write_exact_hit(hits[i], k, i, block);
  }
}

void RayScene::interpolate_hits(const Eigen::Vector3d& eye_W, const SceneRay* rays,
                                const std::uint32_t* triangles, std::size_t count,
                                SurfaceInteraction* points) const {
  const ApproximateTracer quick = impl_->approximate_tracer(eye_W);
  for (std::size_t i = 0; i < count; ++i) {
    if ((triangles[i] & PrimaryRayPacket::kOutside) == 0) {
      quick.interpolate_hits(rays[i], triangles[i], points[i]);
    } else {
      trace_approximately(rays + i, 1, points + i);
    }
  }
}

std::uint64_t RayScene::find_texels(const Eigen::Vector3d& eye_W, const PrimaryRayPacket* blocks,
                                    const TexelRequest* requests, std::size_t count,
                                    SurfaceTexel* texels) const {
  const ApproximateTracer quick = impl_->approximate_tracer(eye_W);
  if (quick.starts_at(eye_W)) return quick.find_texels(eye_W, blocks, requests, count, texels);
  std::fill_n(texels, count, SurfaceTexel{});
  return 0;
}

void RayScene::trace_texels(const Eigen::Vector3d& eye_W, const SurfaceTexel* texels,
                            std::size_t count, SceneRay* rays, SurfaceInteraction* points) const {
  const ApproximateTracer quick = impl_->approximate_tracer(eye_W);
  for (std::size_t k = 0; k < count; ++k) quick.look_at(texels[k], rays[k], points[k]);
}

void RayScene::find_shadows_of_texels(const Eigen::Vector3d& eye_W, const SceneRay* rays,
                                      std::size_t count, bool* in_shadow) const {
  impl_->find_shadows(impl_->approximate_tracer(eye_W), rays, count, in_shadow);
}

bool RayScene::has_models() const { return !impl_->moving.empty(); }

bool RayScene::may_be_shaded(const Eigen::Vector3d& eye_W, const Eigen::Vector3f& at_W,
                             const Eigen::Vector3f& to_lamp_W, float about_m) const {
  const LocalScene* local = impl_->local_scenes.find(eye_W);
  if (local != nullptr) return local->may_shade(at_W, to_lamp_W, about_m);
  return impl_->moving.loose().may_shade(at_W, to_lamp_W, about_m);
}

std::vector<Bounds> RayScene::scenery_boxes() const {
  std::vector<Bounds> boxes;
  for (const TraceableInstance* placed : impl_->scenery.places().places())
    boxes.push_back(placed->bounds_W());
  return boxes;
}

std::size_t RayScene::memory_bytes() const {
  return impl_->device.bytes() + impl_->local_scenes.bytes();
}

std::size_t RayScene::local_scene_triangles() const { return impl_->local_scenes.triangles(); }

std::size_t RayScene::local_scenes_made() const { return impl_->local_scenes.made(); }

}  // namespace ardee::raycast
