// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "ardee_sim/raycast/primary_ray_packet.h"
#include "ardee_sim/raycast/ray_hit.h"
#include "ardee_sim/raycast/scene_ray.h"
#include "ardee_sim/raycast/surface_interaction.h"
#include "ardee_sim/raycast/surface_texel.h"

namespace ardee::raycast {

struct TracedScene;

/// Rays for pictures of a RayScene. The work is the caller's thread's; many threads may call at
/// once. Rays close together are best traced side by side.
///
/// "Approximately" is several times as quick: floats decide what is nearest, so that of two things
/// some micrometres apart the farther may be given. It needs RayScene::prepare() for pictures, and
/// is exact where that has made no local scene.
class PictureTracer {
 public:
  explicit PictureTracer(const TracedScene& scene) : scene_(scene) {}

  /// The first hit of each ray, with all that shading needs.
  void trace(const SceneRay* rays, std::size_t count, SurfaceInteraction* points) const;
  void trace_approximately(const SceneRay* rays, std::size_t count,
                           SurfaceInteraction* points) const;
  /// The first hit of each ray without its material: range, entity, label and normal.
  void intersect(const SceneRay* rays, std::size_t count, RayHit* hits) const;
  /// Whether something that casts shadows lies on a ray within its reach, whichever side it shows.
  void find_shadows(const SceneRay* rays, std::size_t count, bool* in_shadow) const;
  void find_shadows_approximately(const SceneRay* rays, std::size_t count, bool* in_shadow) const;

  /// The many rays from an eye, approximately, packets of four by four pixels: which surface they
  /// hit and where, not what it looks like.
  void trace_primary(const Eigen::Vector3d& eye_W, PrimaryRayPacket* packets,
                     std::size_t count) const;
  /// As trace_approximately, for rays of trace_primary() from `eye_W` that have hit something; they
  /// start at their near_m. `triangles` are those of the packets.
  void interpolate_hits(const Eigen::Vector3d& eye_W, const SceneRay* rays,
                        const std::uint32_t* triangles, std::size_t count,
                        SurfaceInteraction* points) const;

  /// The texels that rays of trace_primary() from `eye_W` have hit, or none where they have hit no
  /// triangle of a triangle scene. Returns the number of that scene, which no other one has; after
  /// the next prepare() it may be gone, and its texels with it.
  std::uint64_t find_texels(const Eigen::Vector3d& eye_W, const PrimaryRayPacket* packets,
                            const TexelRequest* requests, std::size_t count,
                            SurfaceTexel* texels) const;
  /// Rays that look straight at the middles of such texels from a metre off, and what they hit.
  void trace_texels(const Eigen::Vector3d& eye_W, const SurfaceTexel* texels, std::size_t count,
                    SceneRay* rays, SurfaceInteraction* points) const;
  /// find_shadows_approximately() for rays that start on texels found from that eye.
  void find_shadows_of_texels(const Eigen::Vector3d& eye_W, const SceneRay* rays, std::size_t count,
                              bool* in_shadow) const;

  bool has_models() const;
  /// Whether the light of a texel that was found from that eye may change: a moving model may stand
  /// between the place (within `about_m`) and a lamp.
  bool may_be_shaded(const Eigen::Vector3d& eye_W, const Eigen::Vector3f& at_W,
                     const Eigen::Vector3f& to_lamp_W, float about_m) const;

 private:
  const TracedScene& scene_;
};

}  // namespace ardee::raycast
