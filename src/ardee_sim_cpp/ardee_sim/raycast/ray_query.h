// SPDX-License-Identifier: MIT
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>

#include "ardee_sim/raycast/ray_hit.h"
#include "ardee_sim/raycast/surface_interaction.h"
#include "ardee_sim/raycast/traceable.h"

namespace ardee::raycast {

/// Upper bound of a reach, so that a ray of infinite reach has no infinite point.
constexpr double kLongestReach_m = 1e9;

/// Returns a direction without tiny negative components. Embree sorts the rays of a packet by the
/// signs of their components, but gives a component nearer to zero than 1e-18 a positive
/// reciprocal; a negative one would spoil the frustum of all rays of its octant.
inline Eigen::Vector3f embree_direction(const Eigen::Vector3f& direction) {
  constexpr float kTiny = 1e-17f;
  return (direction.array().abs() < kTiny).select(Eigen::Vector3f::Zero(), direction);
}

/// One ray's traversal of the world, with its nearest hit.
///
/// Embree and the float tests only choose candidates: too many, never too few. Each hit is then
/// computed in double precision from the world's ray, the body's own vertices and the body's place.
/// The nearest is kept; (entity, link, shape, primitive) decides ties. So the result does not
/// depend on the way to the candidates.
class RayQuery {
 public:
  /// kShadow: any body that casts shadows ends the ray, near or far, seen from either side.
  enum class Purpose { kNearest, kShadow };

  /// Starts a ray that ignores the link (own_entity, own_link), or all links of that entity.
  void start(const Ray& ray_W, double reach_m, std::uint32_t own_entity, std::uint32_t own_link,
             Purpose purpose = Purpose::kNearest) {
    purpose_ = purpose;
    ray_W_ = ray_W;
    best_t_ = std::min(reach_m, kLongestReach_m);
    own_entity_ = own_entity;
    own_link_ = own_link;
  }

  const Ray& ray_W() const { return ray_W_; }
  /// Greatest t of a candidate that still matters.
  double reach() const { return best_t_; }
  bool is_shadow() const { return purpose_ == Purpose::kShadow; }
  bool has_hit() const { return placed_ != nullptr; }
  /// Returns whether the ray ignores that link because it carries the sensor.
  bool passes(std::uint32_t entity, std::uint32_t link) const {
    return entity == own_entity_ && (link == own_link_ || own_link_ == kAllLinks);
  }

  /// Makes `placed` the body of the next calls.
  void enter(const TraceableInstance& placed) {
    if (entered_ == &placed) return;
    entered_ = &placed;
    ray_B_ = placed.to_body(ray_W_);
  }
  const Ray& ray_B() const { return ray_B_; }

  /// Intersects the whole body, from t_low on.
  void intersect_traceable(const TraceableInstance& placed, double t_low);
  void intersect_primitive(const Primitive& primitive);
  void intersect_block(const TriangleBlock& block);
  void intersect_marked(const TriangleBlock& block, std::uint32_t marks);
  void intersect_solid(const AnalyticSolid& solid);

  void fill(RayHit& hit) const;
  void fill(SurfaceInteraction& point) const;

 private:
  struct Candidate {
    double t;
    std::uint32_t surface;
    std::uint32_t primitive;
    std::uint32_t item;  // index of the triangle, solid or terrain in the body
    Eigen::Vector3d normal_B;
  };

  bool is_hole(const TraceableTriangle& triangle, const Eigen::Vector3d& weights) const;
  void intersect_patch(const TerrainPatch& patch);
  void offer(const Candidate& candidate);
  bool precedes(const Candidate& candidate) const;
  void fill_triangle(SurfaceInteraction& point) const;
  void fill_solid(SurfaceInteraction& point) const;
  void fill_terrain(SurfaceInteraction& point) const;

  Ray ray_W_;
  Ray ray_B_;
  double best_t_ = 0.0;
  std::uint32_t own_entity_ = kNoEntity;
  std::uint32_t own_link_ = 0;
  Purpose purpose_ = Purpose::kNearest;
  const TraceableInstance* entered_ = nullptr;
  const TraceableInstance* placed_ = nullptr;  // the body of the nearest hit
  std::uint32_t surface_ = 0;
  std::uint32_t primitive_ = 0;
  std::uint32_t item_ = 0;
  Eigen::Vector3d normal_B_;
};

/// Number of rays that are traced together: neighbours of a pattern hit much the same boxes. Eight
/// are native from AVX2 on.
constexpr int kPacketRays = 8;

/// Data that Embree passes to the callbacks with each ray; the ray's id is the index of its query.
struct TraversalContext {
  RTCIntersectContext embree;
  RayQuery* queries;
  double t_shift[kPacketRays];  // Embree's t is the world's t minus this
};

/// Stretch of one query's ray in the scene's frame.
struct RaySegment {
  Ray ray;
  double t_low = 0.0;
  double t_high = -1.0;  // below t_low: the query is skipped

  bool empty() const { return !(t_low <= t_high); }
};

/// Packet of rays in Embree's form, empty at first.
struct RayPacket {
  RayPacket();

  alignas(32) int valid[kPacketRays];
  RTCRayHit8 rays;

  /// Adds ray `i` of the packet, in the scene's frame.
  void add(int i, const Ray& ray, double reach);
  /// Returns false if all queries are skipped.
  bool load(const RaySegment* passages);
};

void traverse(RTCSceneTy* scene, RayQuery& query, const RaySegment& passage);
/// Traces a packet; `queries` and `passages` are kPacketRays long.
void traverse_packet(RTCSceneTy* scene, RayQuery* queries, const RaySegment* passages);

/// Returns a float that is safely above the double.
inline float float_above(double t) { return static_cast<float>(t * (1.0 + 1e-6) + 1e-5); }

/// Calls `intersect(query, rays, i, t_shift)` in a callback for each active ray, and shortens the
/// ray to its nearest hit.
template <typename Intersect>
void for_each_ray(const RTCIntersectFunctionNArguments* args, Intersect intersect) {
  const auto* context = reinterpret_cast<const TraversalContext*>(args->context);
  RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, args->N);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const unsigned id = RTCRayN_id(rays, args->N, i);
    RayQuery& query = context->queries[id];
    if (!intersect(query, rays, i, context->t_shift[id])) continue;
    float& t_far = RTCRayN_tfar(rays, args->N, i);
    const float t = float_above(query.reach() - context->t_shift[id]);
    if (t < t_far) t_far = t;
  }
}

/// Callback of the scene over a body's primitives.
void intersect_primitive_of(const RTCIntersectFunctionNArguments* args);

}  // namespace ardee::raycast
