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

/// Traces rays for pictures of a RayScene, in the caller's thread; many threads may call at once.
/// Rays close together are best traced side by side.
///
/// The approximate functions are several times as quick: floats decide which surface is nearest, so
/// that of two surfaces some micrometres apart the farther may be returned. They need
/// RayScene::prepare() for pictures, and are exact where it has made no local scene.
class PictureTracer {
 public:
  explicit PictureTracer(const TracedScene& scene) : scene_(scene) {}

  /// Finds the first hit of each ray, with all that shading needs.
  void trace(const SceneRay* rays, std::size_t count, SurfaceInteraction* points) const;
  void trace_approximately(const SceneRay* rays, std::size_t count,
                           SurfaceInteraction* points) const;
  /// Finds the first hit of each ray without its material: range, entity, label and normal.
  void intersect(const SceneRay* rays, std::size_t count, RayHit* hits) const;
  /// Finds whether a body that casts shadows lies on a ray within its reach, seen from either side.
  void find_shadows(const SceneRay* rays, std::size_t count, bool* in_shadow) const;
  void find_shadows_approximately(const SceneRay* rays, std::size_t count, bool* in_shadow) const;

  /// Traces the many rays from an eye, approximately, in packets of four by four pixels: which
  /// surface they hit and where, without its look.
  void trace_primary(const Eigen::Vector3d& eye_W, PrimaryRayPacket* packets,
                     std::size_t count) const;
  /// Completes hits of trace_primary() from `eye_W` for shading; the rays start at their near_m.
  /// `triangles` are those of the packets.
  void interpolate_hits(const Eigen::Vector3d& eye_W, const SceneRay* rays,
                        const std::uint32_t* triangles, std::size_t count,
                        SurfaceInteraction* points) const;

  /// Finds the texels that rays of trace_primary() from `eye_W` have hit; none for a ray without a
  /// hit on a triangle of a triangle scene. Returns that scene's number, which is unique; the next
  /// prepare() may remove the scene and its texels.
  std::uint64_t find_texels(const Eigen::Vector3d& eye_W, const PrimaryRayPacket* packets,
                            const TexelRequest* requests, std::size_t count,
                            SurfaceTexel* texels) const;
  /// Traces rays at the middles of such texels from one metre above, along the normal.
  void trace_texels(const Eigen::Vector3d& eye_W, const SurfaceTexel* texels, std::size_t count,
                    SceneRay* rays, SurfaceInteraction* points) const;
  /// Finds shadows approximately for rays that start on texels found from that eye.
  void find_shadows_of_texels(const Eigen::Vector3d& eye_W, const SceneRay* rays, std::size_t count,
                              bool* in_shadow) const;

  bool has_models() const;
  /// Returns whether the light of a texel that was found from that eye may change: a moving model
  /// may stand between the place (within `about_m`) and a lamp.
  bool may_be_shaded(const Eigen::Vector3d& eye_W, const Eigen::Vector3f& at_W,
                     const Eigen::Vector3f& to_lamp_W, float about_m) const;

 private:
  const TracedScene& scene_;
};

}  // namespace ardee::raycast
