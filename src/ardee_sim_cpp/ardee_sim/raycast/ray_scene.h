// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "ardee_sim/core/log.h"
#include "ardee_sim/core/pose.h"
#include "ardee_sim/description/scenery.h"
#include "ardee_sim/raycast/bounds.h"
#include "ardee_sim/raycast/picture_places.h"
#include "ardee_sim/raycast/picture_tracer.h"
#include "ardee_sim/raycast/ray_hit.h"
#include "ardee_sim/raycast/ray_options.h"
#include "ardee_sim/raycast/scene_kind.h"
#include "ardee_sim/raycast/scene_ray.h"

namespace ardee::raycast {

/// A triangle of the scenery, or a box about another piece of it.
struct SceneryPart {
  std::vector<Eigen::Vector3d> corners_W;
  bool is_opaque = false;  // a triangle without holes
  bool is_two_sided = true;
};

/// The world as rays see it, on Embree. The hits do not depend on threads, local scenes or timing.
class RayScene {
 public:
  RayScene(SceneKind kind, const RayOptions& options, Log log);
  ~RayScene();

  /// Adds scenery; placement k of the list gets the entity first_entity + k.
  void add_scenery(std::uint32_t first_entity, const std::vector<Placement>& placements);
  /// Removes all scenery that was added with that first entity.
  void remove_scenery(std::uint32_t first_entity);

  /// Adds a moving model with a class for label pictures; set_link_poses() places its links.
  void add_model(std::uint32_t entity, std::shared_ptr<const Model> model, std::uint32_t label = 0);
  void remove_model(std::uint32_t entity);
  /// Sets X_WL of each link of the description, in its order.
  void set_link_poses(std::uint32_t entity, const std::vector<Pose>& X_WL);

  /// Prepares the scene for rays from these points: commits changes and makes local scenes; with
  /// `pictures`, for pictures() too from now on.
  void prepare(const std::vector<Eigen::Vector3d>& eyes_W, bool pictures = false);

  /// Finds the nearest hit within max_range_m for each direction. Rays ignore the link (entity,
  /// link) that carries the sensor (kNoEntity: none). In the visual scene, one-sided surfaces are
  /// invisible from behind, and texels below a material's alpha rejection are holes. The work is
  /// parallel inside; call it from one thread at a time.
  void cast(const Pose& X_WS, const RayPattern& pattern, float max_range_m,
            std::uint32_t own_entity, std::uint32_t own_link, std::vector<RayHit>& hits) const;
  /// Does the same for rays with their own origins and reaches; `own_link` may be kAllLinks.
  void cast(const std::vector<SceneRay>& rays, std::uint32_t own_entity, std::uint32_t own_link,
            std::vector<RayHit>& hits) const;
  /// Does the same with one moving model alone, without its link `own_link`.
  void cast_at_model(const std::vector<SceneRay>& rays, std::uint32_t entity,
                     std::uint32_t own_link, std::vector<RayHit>& hits) const;

  /// Where the local scenes of pictures lie, which depends on where earlier pictures were taken.
  PicturePlaces picture_places() const;
  void set_picture_places(const PicturePlaces& places);

  /// Traces rays for pictures of this scene.
  const PictureTracer& pictures() const;

  /// Boxes about each place of the scenery, without infinite planes; valid after prepare().
  std::vector<Bounds> scenery_boxes() const;
  /// Calls `act` with each part of the scenery, without infinite planes; valid after prepare().
  void for_each_part(const std::function<void(const SceneryPart&)>& act) const;

  /// Numbers for benchmarks: bytes of Embree (for all scenes of this process) and of local scenes,
  /// triangles of local scenes, and how many of them were taken into use so far.
  std::size_t memory_bytes() const;
  std::size_t local_scene_triangles() const;
  std::size_t local_scenes_taken() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ardee::raycast
