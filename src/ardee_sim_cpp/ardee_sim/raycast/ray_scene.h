// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "ardee_sim/core/log.h"
#include "ardee_sim/core/pose.h"
#include "ardee_sim/description/scenery.h"
#include "ardee_sim/raycast/bounds.h"
#include "ardee_sim/raycast/picture_tracer.h"
#include "ardee_sim/raycast/ray_hit.h"
#include "ardee_sim/raycast/ray_options.h"
#include "ardee_sim/raycast/scene_kind.h"
#include "ardee_sim/raycast/scene_ray.h"

namespace ardee::raycast {

/// The world as rays see it, on Embree. What a ray returns does not depend on threads, on local
/// scenes or on timing.
class RayScene {
 public:
  RayScene(SceneKind kind, const RayOptions& options, Log log);
  ~RayScene();

  /// Placement k of the list gets the entity first_entity + k.
  void add_scenery(std::uint32_t first_entity, const std::vector<Placement>& placements);
  /// Removes all that was added with that first entity.
  void remove_scenery(std::uint32_t first_entity);

  /// Adds a moving model: its links are placed by set_link_poses.
  void add_model(std::uint32_t entity, std::shared_ptr<const Model> model);
  void remove_model(std::uint32_t entity);
  /// X_WL of each link of the description, in its order.
  void set_link_poses(std::uint32_t entity, const std::vector<Pose>& X_WL);

  /// Makes the scene ready for rays from these points: commits what has changed and makes local
  /// scenes. `pictures`: from now on also for pictures().
  void prepare(const std::vector<Eigen::Vector3d>& eyes_W, bool pictures = false);

  /// Hits nearest to the origin within max_range_m, one a direction. Rays pass through the link
  /// (entity, link) that carries the sensor: pass kNoEntity for none. One-sided surfaces are not
  /// met from behind in the visual scene; texels below a material's alpha rejection are holes.
  /// Inside it the work is parallel; call it from one thread at a time.
  void cast(const Pose& X_WS, const RayPattern& pattern, float max_range_m,
            std::uint32_t own_entity, std::uint32_t own_link, std::vector<RayHit>& hits) const;
  /// As above for rays with origins and reaches of their own; `own_link` may be kAllLinks.
  void cast(const std::vector<SceneRay>& rays, std::uint32_t own_entity, std::uint32_t own_link,
            std::vector<RayHit>& hits) const;
  /// The same of one moving model alone, its link `own_link` left out.
  void cast_at_model(const std::vector<SceneRay>& rays, std::uint32_t entity,
                     std::uint32_t own_link, std::vector<RayHit>& hits) const;

  /// Rays for pictures of this scene.
  const PictureTracer& pictures() const;

  /// About each place of the scenery, infinite planes left out; valid after prepare().
  std::vector<Bounds> scenery_boxes() const;

  /// For benchmarks: bytes held by Embree and local scenes, triangles in the latter, and how many
  /// of them were made so far.
  std::size_t memory_bytes() const;
  std::size_t local_scene_triangles() const;
  std::size_t local_scenes_made() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ardee::raycast
