// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/raycast/moving_models.h"
#include "ardee_sim/raycast/near_regions.h"

namespace ardee {

/// Writes what ray `i` of the block with that number has met exactly, from its near_m on.
void see_exactly(const RayHit& hit, std::size_t number, int i, GlanceBlock& block);

/// Looks for pictures by the draft of the near region that the rays start in: what is nearest among
/// its triangles is decided in floats. All else on a ray's way is met exactly.
class QuickLook {
 public:
  QuickLook(const NearRegion* region, const SceneryStore& scenery, const MovingModels& moving)
      : region_(region), scenery_(scenery), moving_(moving) {}

  /// Up to kPacketRays rays. False if they have to be met exactly: they do not start in a draft.
  bool look(const SceneRay* rays, int count, SurfacePoint* points) const;
  bool find_shadows(const SceneRay* rays, int count, bool* in_shadow) const;

  /// Whether rays from there start in a draft.
  bool starts_at(const Eigen::Vector3d& eye_W) const;
  /// Any number of blocks of rays from such a point.
  void glance(const Eigen::Vector3d& eye_W, GlanceBlock* blocks, std::size_t count) const;
  /// What a ray that was glanced at has met in the draft.
  void look_closer(const SceneRay& ray, std::uint32_t triangle, SurfacePoint& point) const;

  /// The cells where rays of blocks from such a point have met the draft; none where they met
  /// something else, or where rays from the cell might not start in it. Returns the draft's number.
  std::uint64_t find_cells(const Eigen::Vector3d& eye_W, const GlanceBlock* blocks,
                           const CellRequest* requests, std::size_t count,
                           SurfaceCell* cells) const;
  /// A ray from a metre off the cell's middle, along its normal, and what it meets.
  void look_at(const SurfaceCell& cell, SceneRay& ray, SurfacePoint& point) const;

 private:
  /// False if a ray starts outside.
  bool load(const SceneRay* rays, int count, RayPacket& packet) const;
  /// What is not in the draft, for rays that have gone `reach_m` (infinite: as far as they may) in
  /// it. False if nothing is near any of them; then the queries are not started.
  bool meet_others(const SceneRay* rays, int count, const double reach_m[kPacketRays],
                   RayQuery::Purpose purpose, RayQuery queries[kPacketRays]) const;

  /// The models that are neither in the draft nor asked for by the tree.
  const ModelList& others() const;
  /// Of all that a ray may meet beyond the region.
  double top_W() const;

  /// Replaces what is farther than something that is not in the draft.
  void glance_at_others(const Eigen::Vector3d& eye_W, std::size_t number, GlanceBlock& block) const;

  const NearRegion* region_;
  const SceneryStore& scenery_;
  const MovingModels& moving_;
};

}  // namespace ardee
