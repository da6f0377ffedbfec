// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/picture_tracer.h"

#include <algorithm>
#include <vector>

#include "ardee_sim/raycast/approximate_tracer.h"
#include "ardee_sim/raycast/traced_scene.h"

namespace ardee::raycast {
namespace {

ApproximateTracer tracer_at(const TracedScene& scene, const Eigen::Vector3d& eye_W) {
  return {scene.local_scenes.find(eye_W), *scene.scenery.fixed(), scene.moving};
}

/// Traces packets of rays by `approximate(first, count)` if it returns true, else exactly, with
/// `take(query, index)` for each ray.
template <typename Approximate, typename Take>
void trace_packets(const TracedScene& scene, const SceneRay* rays, std::size_t count,
                   RayQuery::Purpose purpose, Approximate approximate, Take take) {
  scene.require_committed();
  for (std::size_t first = 0; first < count; first += kPacketRays) {
    const int packet = static_cast<int>(std::min<std::size_t>(kPacketRays, count - first));
    if (approximate(first, packet)) continue;
    RayQuery queries[kPacketRays];
    scene.trace(rays + first, packet, purpose, kNoEntity, 0, queries);
    for (int k = 0; k < packet; ++k) take(queries[k], first + static_cast<std::size_t>(k));
  }
}

constexpr auto kNeverApproximate = [](std::size_t, int) { return false; };

void find_shadows_by(const ApproximateTracer& tracer, const TracedScene& scene,
                     const SceneRay* rays, std::size_t count, bool* in_shadow) {
  trace_packets(
      scene, rays, count, RayQuery::Purpose::kShadow,
      [&](std::size_t first, int packet) {
        return tracer.find_shadows(rays + first, packet, in_shadow + first);
      },
      [in_shadow](const RayQuery& query, std::size_t i) { in_shadow[i] = query.has_hit(); });
}

}  // namespace

void PictureTracer::trace(const SceneRay* rays, std::size_t count,
                          SurfaceInteraction* points) const {
  trace_packets(scene_, rays, count, RayQuery::Purpose::kNearest, kNeverApproximate,
                [points](const RayQuery& query, std::size_t i) { query.fill(points[i]); });
}

void PictureTracer::trace_approximately(const SceneRay* rays, std::size_t count,
                                        SurfaceInteraction* points) const {
  if (count == 0) return;
  const ApproximateTracer tracer = tracer_at(scene_, rays[0].origin_W);
  trace_packets(
      scene_, rays, count, RayQuery::Purpose::kNearest,
      [&](std::size_t first, int packet) {
        return tracer.trace(rays + first, packet, points + first);
      },
      [points](const RayQuery& query, std::size_t i) { query.fill(points[i]); });
}

void PictureTracer::intersect(const SceneRay* rays, std::size_t count, RayHit* hits) const {
  trace_packets(scene_, rays, count, RayQuery::Purpose::kNearest, kNeverApproximate,
                [hits](const RayQuery& query, std::size_t i) { query.fill(hits[i]); });
}

void PictureTracer::find_shadows(const SceneRay* rays, std::size_t count, bool* in_shadow) const {
  trace_packets(
      scene_, rays, count, RayQuery::Purpose::kShadow, kNeverApproximate,
      [in_shadow](const RayQuery& query, std::size_t i) { in_shadow[i] = query.has_hit(); });
}

void PictureTracer::find_shadows_approximately(const SceneRay* rays, std::size_t count,
                                               bool* in_shadow) const {
  if (count == 0) return;
  find_shadows_by(tracer_at(scene_, rays[0].origin_W), scene_, rays, count, in_shadow);
}

void PictureTracer::trace_primary(const Eigen::Vector3d& eye_W, PrimaryRayPacket* packets,
                                  std::size_t count) const {
  scene_.require_committed();
  const ApproximateTracer tracer = tracer_at(scene_, eye_W);
  if (tracer.starts_at(eye_W)) return tracer.trace_primary(eye_W, packets, count);
  for (std::size_t k = 0; k < count; ++k) {
    PrimaryRayPacket& packet = packets[k];
    SceneRay rays[PrimaryRayPacket::kRays];
    RayHit hits[PrimaryRayPacket::kRays];
    for (int i = 0; i < PrimaryRayPacket::kRays; ++i) {
      const Eigen::Vector3d way_W = packet.direction_W(i).cast<double>();
      const auto near_m = static_cast<double>(packet.near_m[i]);
      rays[i] = {eye_W + near_m * way_W, way_W, static_cast<double>(packet.far_m[i]) - near_m};
    }
    intersect(rays, PrimaryRayPacket::kRays, hits);
    for (int i = 0; i < PrimaryRayPacket::kRays; ++i) write_exact_hit(hits[i], k, i, packet);
  }
}

void PictureTracer::interpolate_hits(const Eigen::Vector3d& eye_W, const SceneRay* rays,
                                     const std::uint32_t* triangles, std::size_t count,
                                     SurfaceInteraction* points) const {
  const ApproximateTracer tracer = tracer_at(scene_, eye_W);
  std::vector<SceneRay> outside;  // together, because single rays take several times as long
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < count; ++i) {
    if ((triangles[i] & PrimaryRayPacket::kOutside) == 0) {
      tracer.interpolate_hit(rays[i], triangles[i], points[i]);
    } else {
      outside.push_back(rays[i]);
      places.push_back(i);
    }
  }
  std::vector<SurfaceInteraction> hits(outside.size());
  trace_approximately(outside.data(), outside.size(), hits.data());
  for (std::size_t k = 0; k < hits.size(); ++k) points[places[k]] = hits[k];
}

std::uint64_t PictureTracer::find_texels(const Eigen::Vector3d& eye_W,
                                         const PrimaryRayPacket* packets,
                                         const TexelRequest* requests, std::size_t count,
                                         SurfaceTexel* texels) const {
  const ApproximateTracer tracer = tracer_at(scene_, eye_W);
  if (tracer.starts_at(eye_W)) return tracer.find_texels(eye_W, packets, requests, count, texels);
  std::fill_n(texels, count, SurfaceTexel{});
  return 0;
}

void PictureTracer::trace_texels(const Eigen::Vector3d& eye_W, const SurfaceTexel* texels,
                                 std::size_t count, SceneRay* rays,
                                 SurfaceInteraction* points) const {
  const ApproximateTracer tracer = tracer_at(scene_, eye_W);
  for (std::size_t k = 0; k < count; ++k) tracer.trace_texel(texels[k], rays[k], points[k]);
}

void PictureTracer::find_shadows_of_texels(const Eigen::Vector3d& eye_W, const SceneRay* rays,
                                           std::size_t count, bool* in_shadow) const {
  find_shadows_by(tracer_at(scene_, eye_W), scene_, rays, count, in_shadow);
}

bool PictureTracer::has_models() const { return !scene_.moving.empty(); }

bool PictureTracer::may_be_shaded(const Eigen::Vector3d& eye_W, const Eigen::Vector3f& at_W,
                                  const Eigen::Vector3f& to_lamp_W, float about_m) const {
  const LocalSceneInUse* local = scene_.local_scenes.find(eye_W);
  if (local != nullptr) return local->beside.may_shade(at_W, to_lamp_W, about_m);
  return scene_.moving.loose().may_shade(at_W, to_lamp_W, about_m);
}

}  // namespace ardee::raycast
