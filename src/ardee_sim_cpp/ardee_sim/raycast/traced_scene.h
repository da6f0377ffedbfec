// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/log.h"
#include "ardee_sim/raycast/local_scene_cache.h"
#include "ardee_sim/raycast/moving_models.h"
#include "ardee_sim/raycast/ray_options.h"
#include "ardee_sim/raycast/scene_ray.h"
#include "ardee_sim/raycast/scenery_store.h"

namespace ardee::raycast {

/// Everything that rays may hit, and the traversal of exact rays, for RayScene and PictureTracer.
struct TracedScene {
  TracedScene(SceneKind kind, const RayOptions& options, Log log);

  /// Traces rays of one origin, in packets of up to kPacketRays: within `local` (null: none) first,
  /// and beyond it only those that leave it without a hit.
  void trace(RayQuery queries[kPacketRays], int count, const LocalScene* local) const;
  /// Traces up to kPacketRays rays of any origins, from their start.
  void trace(const SceneRay* rays, int count, RayQuery::Purpose purpose, std::uint32_t own_entity,
             std::uint32_t own_link, RayQuery queries[kPacketRays]) const;
  /// Throws Error if scenery has changed since the last commit.
  void require_committed() const;

  Log log;
  SceneryStore scenery;
  MovingModels moving;
  LocalSceneCache local_scenes;
};

}  // namespace ardee::raycast
