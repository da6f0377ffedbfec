// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "ardee_sim/core/log.h"
#include "ardee_sim/core/pose.h"
#include "ardee_sim/description/scenery.h"
#include "ardee_sim/raycast/bounds.h"
#include "ardee_sim/raycast/primary_ray_packet.h"
#include "ardee_sim/raycast/surface_interaction.h"
#include "ardee_sim/raycast/surface_texel.h"

namespace ardee::raycast {

/// Which bodies of the links rays meet (thesis 4.3.3).
enum class SceneKind { kVisual, kCollision };

/// What a ray met first.
struct RayHit {
  float range_m = 0.0f;  // +inf: nothing within the maximum
  std::uint32_t entity =
      kNoEntity;  // what was passed to add_scenery or add_model (plus the placement's index)
  std::uint32_t link = 0;   // index in the model's description
  std::uint32_t shape = 0;  // index of the visual or collision in the link
  std::uint32_t label = 0;
  float laser_retro = 0.0f;
  float reflectivity = 0.0f;          // laser_retro if given, else of the diffuse colour, 0 to 1
  Eigen::Vector3f normal_W{0, 0, 0};  // unit, towards the ray's origin
};

/// Unit directions in the sensor's frame, all from its origin: a lidar's, sonar's or camera's
/// pattern as data.
struct RayPattern {
  std::vector<Eigen::Vector3f> directions_S;
};

struct RayOptions {
  int threads = 0;  // 0: all cores
  /// Of scenery held primitive by primitive about sensors.
  std::size_t local_scene_budget_bytes = 512u << 20;
  /// It reaches at least this far about a sensor, if the budget allows (measured: README.md).
  double local_scene_radius_m = 6.0;
  /// False: instances only. What rays return is the same.
  bool local_scenes = true;
};

/// The world as rays see it, on Embree. What a ray returns does not depend on threads, on tiles or
/// on timing.
class RayScene {
 public:
  RayScene(SceneKind kind, const RayOptions& options, Log log);
  ~RayScene();

  /// Placement k of the list gets the entity first_entity + k.
  void add_scenery(std::uint32_t first_entity, const std::vector<Placement>& placements);
  /// `count` as added.
  void remove_scenery(std::uint32_t first_entity);

  /// A moving model: its links are placed by set_link_poses.
  void add_model(std::uint32_t entity, std::shared_ptr<const Model> model);
  void remove_model(std::uint32_t entity);
  /// X_WL of each link of the description, in its order.
  void set_link_poses(std::uint32_t entity, const std::vector<Pose>& X_WL);

  /// Makes the scene ready for rays from these points: commits what moved, flattens tiles that came
  /// near.
  /// `pictures`: from now on also for trace_approximately.
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
  /// What of one moving model alone the rays meet, its link `own_link` left out.
  void cast_at_model(const std::vector<SceneRay>& rays, std::uint32_t entity,
                     std::uint32_t own_link, std::vector<RayHit>& hits) const;

  /// For pictures: what each of `count` rays meets first, with its look. Rays close together are
  /// best asked side by side. The work is the caller's thread's; many threads may call at once.
  void trace(const SceneRay* rays, std::size_t count, SurfaceInteraction* points) const;
  /// The same, several times as quick: what is nearest is decided in floats, so that of two things
  /// some micrometres apart the farther may be given. Needs prepare() for pictures to be quick.
  void trace_approximately(const SceneRay* rays, std::size_t count,
                           SurfaceInteraction* points) const;
  void find_shadows_approximately(const SceneRay* rays, std::size_t count, bool* in_shadow) const;
  /// For the many rays of a picture, best in blocks of four by four: what they meet, but not how it
  /// looks.
  void trace_primary(const Eigen::Vector3d& eye_W, PrimaryRayPacket* blocks,
                     std::size_t count) const;
  /// As trace_approximately, for rays of `eye_W` that have been glanced at and have met something;
  /// they start at their near_m. `triangles` are those of the glances.
  void interpolate_hits(const Eigen::Vector3d& eye_W, const SceneRay* rays,
                        const std::uint32_t* triangles, std::size_t count,
                        SurfaceInteraction* points) const;
  /// The texels where rays of `eye_W` have met a triangle scene by a glance, or none. Returns the
  /// triangle scene's number, which no other one has: texels are its own, and it may be gone after
  /// prepare().
  std::uint64_t find_texels(const Eigen::Vector3d& eye_W, const PrimaryRayPacket* blocks,
                            const TexelRequest* requests, std::size_t count,
                            SurfaceTexel* texels) const;
  /// Rays that look straight at the middles of such texels from a metre off, and what they meet.
  void trace_texels(const Eigen::Vector3d& eye_W, const SurfaceTexel* texels, std::size_t count,
                    SceneRay* rays, SurfaceInteraction* points) const;
  /// find_shadows_approximately() for rays that start on texels found from that eye.
  void find_shadows_of_texels(const Eigen::Vector3d& eye_W, const SceneRay* rays, std::size_t count,
                              bool* in_shadow) const;
  bool has_models() const;
  /// Whether the light of a texel that was found from that eye may change: a moving model may stand
  /// in the way from about the place (within `about_m`) to a lamp.
  bool may_be_shaded(const Eigen::Vector3d& eye_W, const Eigen::Vector3f& at_W,
                     const Eigen::Vector3f& to_lamp_W, float about_m) const;
  /// The same without the look: range, entity, label and normal.
  void intersect(const SceneRay* rays, std::size_t count, RayHit* hits) const;
  /// Whether something that casts shadows lies on a ray within its reach, whichever side it shows.
  void find_shadows(const SceneRay* rays, std::size_t count, bool* in_shadow) const;

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
