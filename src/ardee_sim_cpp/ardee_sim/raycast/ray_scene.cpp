// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/ray_scene.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "ardee_sim/raycast/traced_scene.h"

namespace ardee::raycast {
namespace {

/// Number of rays that a thread takes at once: tens of microseconds of work.
constexpr std::size_t kGrain = 64;

}  // namespace

struct RayScene::Impl {
  Impl(SceneKind kind, const RayOptions& options, Log log)
      : scene(kind, options, std::move(log)),
        pictures(scene),
        arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic) {
    // TBB has at most one worker a core unless told otherwise.
    if (options.threads > tbb::info::default_concurrency()) {
      workers = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                      static_cast<std::size_t>(options.threads));
    }
  }

  /// Calls trace_some(first, count, queries) for packets of rays in all threads, and stores their
  /// hits.
  template <typename TraceSome>
  void trace_in_parallel(std::size_t rays, std::vector<RayHit>& hits, TraceSome trace_some) const {
    scene.require_committed();
    hits.resize(rays);
    arena.execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays, kGrain),
                        [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i < range.end(); i += kPacketRays) {
                            const int count = static_cast<int>(
                                std::min<std::size_t>(kPacketRays, range.end() - i));
                            RayQuery queries[kPacketRays];
                            trace_some(i, count, queries);
                            for (int k = 0; k < count; ++k) {
                              queries[k].fill(hits[i + static_cast<std::size_t>(k)]);
                            }
                          }
                        });
    });
  }

  TracedScene scene;
  PictureTracer pictures;
  std::unique_ptr<tbb::global_control> workers;
  mutable tbb::task_arena arena;
};

RayScene::RayScene(SceneKind kind, const RayOptions& options, Log log)
    : impl_(std::make_unique<Impl>(kind, options, std::move(log))) {}

RayScene::~RayScene() = default;

void RayScene::add_scenery(std::uint32_t first_entity, const std::vector<Placement>& placements) {
  impl_->scene.local_scenes.clear();
  impl_->scene.scenery.add(first_entity, placements);
}

void RayScene::remove_scenery(std::uint32_t first_entity) {
  impl_->scene.local_scenes.clear();
  impl_->scene.scenery.remove(first_entity);
}

void RayScene::add_model(std::uint32_t entity, std::shared_ptr<const Model> model,
                         std::uint32_t label) {
  impl_->scene.moving.add(entity, std::move(model), label);
}

void RayScene::remove_model(std::uint32_t entity) { impl_->scene.moving.remove(entity); }

void RayScene::set_link_poses(std::uint32_t entity, const std::vector<Pose>& X_WL) {
  impl_->scene.moving.set_link_poses(entity, X_WL);
}

void RayScene::prepare(const std::vector<Eigen::Vector3d>& eyes_W, bool pictures) {
  for (const Eigen::Vector3d& eye : eyes_W) {
    if (!eye.allFinite()) throw Error("ray scene: a sensor's position is not finite");
  }
  if (!impl_->scene.scenery.committed()) impl_->scene.scenery.commit();
  impl_->scene.moving.prepare();
  impl_->scene.local_scenes.prepare(eyes_W, pictures);
}

PicturePlaces RayScene::picture_places() const {
  return impl_->scene.local_scenes.picture_places();
}

void RayScene::set_picture_places(const PicturePlaces& places) {
  impl_->scene.local_scenes.set_picture_places(places);
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
  const LocalSceneInUse* found = impl_->scene.local_scenes.find(X_WS.p);
  const LocalScene* local = found != nullptr ? found->scene.get() : nullptr;
  const Eigen::Matrix3d R_WS = X_WS.q.normalized().toRotationMatrix();
  const auto trace_some = [&](std::size_t first, int count, RayQuery* queries) {
    for (int k = 0; k < count; ++k) {
      const Eigen::Vector3f& direction_S =
          pattern.directions_S[first + static_cast<std::size_t>(k)];
      const Eigen::Vector3d direction = (R_WS * direction_S.cast<double>()).normalized();
      queries[k].start({X_WS.p, direction}, static_cast<double>(max_range_m), own_entity, own_link);
    }
    impl_->scene.trace(queries, count, local);
  };
  impl_->trace_in_parallel(pattern.directions_S.size(), hits, trace_some);
}

void RayScene::cast(const std::vector<SceneRay>& rays, std::uint32_t own_entity,
                    std::uint32_t own_link, std::vector<RayHit>& hits) const {
  require_sane(rays);
  impl_->trace_in_parallel(rays.size(), hits, [&](std::size_t first, int count, RayQuery* queries) {
    impl_->scene.trace(rays.data() + first, count, RayQuery::Purpose::kNearest, own_entity,
                       own_link, queries);
  });
}

void RayScene::cast_at_model(const std::vector<SceneRay>& rays, std::uint32_t entity,
                             std::uint32_t own_link, std::vector<RayHit>& hits) const {
  require_sane(rays);
  impl_->trace_in_parallel(rays.size(), hits, [&](std::size_t first, int count, RayQuery* queries) {
    for (int k = 0; k < count; ++k) {
      const SceneRay& ray = rays[first + static_cast<std::size_t>(k)];
      queries[k].start({ray.origin_W, ray.direction_W}, ray.reach_m, entity, own_link);
      impl_->scene.moving.intersect(queries[k], entity);
    }
  });
}

const PictureTracer& RayScene::pictures() const { return impl_->pictures; }

std::vector<Bounds> RayScene::scenery_boxes() const {
  std::vector<Bounds> boxes;
  for (const TraceableInstance* placed : impl_->scene.scenery.fixed()->places().places())
    boxes.push_back(placed->bounds_W());
  return boxes;
}

void RayScene::for_each_part(const std::function<void(const SceneryPart&)>& act) const {
  SceneryPart triangle_part, box;
  triangle_part.corners_W.resize(3);
  box.corners_W.resize(8);
  for (const TraceableInstance* placed : impl_->scene.scenery.fixed()->places().places()) {
    const Traceable& body = *placed->body;
    const auto to_world = [&](const Eigen::Vector3d& p_B) -> Eigen::Vector3d {
      return placed->p + placed->q * (placed->scale * p_B);
    };
    for (const TraceableTriangle& triangle : body.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        triangle_part.corners_W[k] = to_world(body.vertices[triangle.vertices[k]].cast<double>());
      }
      const TraceableSurface& surface = body.surfaces[triangle.surface];
      triangle_part.is_opaque = surface.mask == nullptr;
      triangle_part.is_two_sided = surface.two_sided;
      act(triangle_part);
    }
    for (std::size_t i = 0; i < body.primitives.size(); ++i) {
      if (body.primitives[i].kind == Primitive::Kind::kBlock) continue;
      for (unsigned k = 0; k < 8; ++k) {
        box.corners_W[k] = to_world(body.primitive_bounds[i].corner(k));
      }
      act(box);
    }
  }
}

std::size_t RayScene::memory_bytes() const {
  return embree_bytes() + impl_->scene.local_scenes.bytes();
}

std::size_t RayScene::local_scene_triangles() const {
  return impl_->scene.local_scenes.triangles();
}

std::size_t RayScene::local_scenes_taken() const { return impl_->scene.local_scenes.taken(); }

}  // namespace ardee::raycast
