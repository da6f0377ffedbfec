// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/raycast/local_scene_cache.h"
#include "ardee_sim/raycast/moving_models.h"
#include "ardee_sim/raycast/primary_ray_packet.h"
#include "ardee_sim/raycast/scene_ray.h"
#include "ardee_sim/raycast/surface_texel.h"

namespace ardee::raycast {

/// Writes the exact hit of ray `i` of the block with that number, from the ray's near_m on.
void write_exact_hit(const RayHit& hit, std::size_t number, int i, PrimaryRayPacket& block);

/// Traces rays for pictures in the triangle scene of the local scene that they start in: floats
/// decide which of its triangles is nearest. All other bodies on a ray's way are tested exactly.
class ApproximateTracer {
 public:
  /// `in_use` may be null: there is none.
  ApproximateTracer(const LocalSceneInUse* in_use, const FixedScenery& scenery,
                    const MovingModels& moving)
      : local_(in_use != nullptr ? in_use->scene.get() : nullptr),
        beside_(in_use != nullptr ? &in_use->beside : nullptr),
        scenery_(scenery),
        moving_(moving) {}

  /// Traces up to kPacketRays rays. Returns false if they do not start in a triangle scene; then
  /// the caller traces them exactly.
  bool trace(const SceneRay* rays, int count, SurfaceInteraction* points) const;
  bool find_shadows(const SceneRay* rays, int count, bool* in_shadow) const;

  /// Returns whether rays from this point start in a triangle scene.
  bool starts_at(const Eigen::Vector3d& eye_W) const;
  /// Traces any number of blocks of rays from such a point.
  void trace_primary(const Eigen::Vector3d& eye_W, PrimaryRayPacket* blocks,
                     std::size_t count) const;
  /// Computes the surface data where a ray of trace_primary() has hit the triangle scene.
  void interpolate_hit(const SceneRay& ray, std::uint32_t triangle,
                       SurfaceInteraction& point) const;

  /// Finds the texels where rays of blocks from such a point have hit the triangle scene; none for
  /// other hits, or if rays from the texel might not start in the triangle scene. Returns the
  /// triangle scene's number.
  std::uint64_t find_texels(const Eigen::Vector3d& eye_W, const PrimaryRayPacket* blocks,
                            const TexelRequest* requests, std::size_t count,
                            SurfaceTexel* texels) const;
  /// Traces a ray from one metre above the texel's middle, along its normal.
  void trace_texel(const SurfaceTexel& texel, SceneRay& ray, SurfaceInteraction& point) const;

 private:
  /// Returns false if a ray starts outside.
  bool load(const SceneRay* rays, int count, RayPacket& packet) const;
  /// Intersects the bodies outside the triangle scene, for rays that have gone `reach_m` (infinite:
  /// their whole reach) in it. Returns false, without starting the queries, if no such body is near
  /// any of them.
  bool intersect_others(const SceneRay* rays, int count, const double reach_m[kPacketRays],
                        RayQuery::Purpose purpose, RayQuery queries[kPacketRays]) const;

  /// Models that are neither in the triangle scene nor found by the tree.
  const ModelList& others() const;
  /// Greatest height of all bodies beyond the local scene.
  double top_W() const;

  /// Replaces hits by nearer ones on bodies outside the triangle scene.
  void trace_primary_others(const Eigen::Vector3d& eye_W, std::size_t number,
                            PrimaryRayPacket& block) const;

  const LocalScene* local_;
  const ModelsBeside* beside_;
  const FixedScenery& scenery_;
  const MovingModels& moving_;
};

}  // namespace ardee::raycast
