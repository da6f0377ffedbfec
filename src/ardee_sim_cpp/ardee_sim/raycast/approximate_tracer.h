// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/raycast/local_scene.h"
#include "ardee_sim/raycast/moving_models.h"
#include "ardee_sim/raycast/primary_ray_packet.h"
#include "ardee_sim/raycast/scene_ray.h"
#include "ardee_sim/raycast/surface_texel.h"

namespace ardee::raycast {

/// Writes what ray `i` of the block with that number has met exactly, from its near_m on.
void write_exact_hit(const RayHit& hit, std::size_t number, int i, PrimaryRayPacket& block);

/// Traces rays for pictures by the triangle scene of the local scene that they start in: floats
/// decide what is nearest among its triangles. All else on a ray's way is met exactly.
class ApproximateTracer {
 public:
  ApproximateTracer(const LocalScene* local, const SceneryStore& scenery,
                    const MovingModels& moving)
      : local_(local), scenery_(scenery), moving_(moving) {}

  /// Up to kPacketRays rays. False if they have to be met exactly: they do not start in a triangle
  /// scene.
  bool trace(const SceneRay* rays, int count, SurfaceInteraction* points) const;
  bool find_shadows(const SceneRay* rays, int count, bool* in_shadow) const;

  /// Whether rays from there start in a triangle scene.
  bool starts_at(const Eigen::Vector3d& eye_W) const;
  /// Any number of blocks of rays from such a point.
  void trace_primary(const Eigen::Vector3d& eye_W, PrimaryRayPacket* blocks,
                     std::size_t count) const;
  /// What a ray of trace_primary() has hit in the triangle scene.
  void interpolate_hit(const SceneRay& ray, std::uint32_t triangle,
                       SurfaceInteraction& point) const;

  /// The texels where rays of blocks from such a point have met the triangle scene; none where they
  /// met something else, or where rays from the texel might not start in it. Returns the triangle
  /// scene's number.
  std::uint64_t find_texels(const Eigen::Vector3d& eye_W, const PrimaryRayPacket* blocks,
                            const TexelRequest* requests, std::size_t count,
                            SurfaceTexel* texels) const;
  /// A ray from a metre off the texel's middle, along its normal, and what it meets.
  void trace_texel(const SurfaceTexel& texel, SceneRay& ray, SurfaceInteraction& point) const;

 private:
  /// False if a ray starts outside.
  bool load(const SceneRay* rays, int count, RayPacket& packet) const;
  /// What is not in the triangle scene, for rays that have gone `reach_m` (infinite: as far as they
  /// may) in it. False if nothing is near any of them; then the queries are not started.
  bool intersect_others(const SceneRay* rays, int count, const double reach_m[kPacketRays],
                        RayQuery::Purpose purpose, RayQuery queries[kPacketRays]) const;

  /// The models that are neither in the triangle scene nor asked for by the tree.
  const ModelList& others() const;
  /// Of all that a ray may meet beyond the local scene.
  double top_W() const;

  /// Replaces what is farther than something that is not in the triangle scene.
  void trace_primary_others(const Eigen::Vector3d& eye_W, std::size_t number,
                            PrimaryRayPacket& block) const;

  const LocalScene* local_;
  const SceneryStore& scenery_;
  const MovingModels& moving_;
};

}  // namespace ardee::raycast
