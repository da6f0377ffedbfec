// SPDX-License-Identifier: MIT
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>

#include "ardee_sim/raycast/ray_hit.h"
#include "ardee_sim/raycast/surface_interaction.h"
#include "ardee_sim/raycast/traceable.h"

namespace ardee::raycast {

/// Nothing is met beyond it, so that a ray of infinite reach has no infinite place on it.
constexpr double kLongestReach_m = 1e9;

/// A direction as Embree takes it. Embree sorts the rays of a packet by the signs of their
/// components, but gives a component nearer to zero than 1e-18 a positive reciprocal whatever its
/// sign; a negative one would spoil the frustum of all rays of its octant. None is left here.
inline Eigen::Vector3f embree_direction(const Eigen::Vector3f& direction) {
  constexpr float kTiny = 1e-17f;
  return (direction.array().abs() < kTiny).select(Eigen::Vector3f::Zero(), direction);
}

/// One ray on its way through the world, and the nearest thing that it has met.
///
/// What Embree and the float tests do is to sort out: they may name too much, never too little.
/// Each hit is then computed in double precision from the world's ray, the body's own vertices and
/// the body's place, and the nearest is kept, ties being decided by (entity, link, shape,
/// primitive). So the result is the same whatever way led to the candidates.
class RayQuery {
 public:
  /// Shadow: whatever casts one ends the ray, near or far, seen from either side.
  enum class Purpose { kNearest, kShadow };

  /// Rays meet nothing of the link (own_entity, own_link), or of all links of that entity.
  void start(const Ray& ray_W, double reach_m, std::uint32_t own_entity, std::uint32_t own_link,
             Purpose purpose = Purpose::kNearest) {
    purpose_ = purpose;
    ray_W_ = ray_W;
    best_t_ = std::min(reach_m, kLongestReach_m);
    own_entity_ = own_entity;
    own_link_ = own_link;
  }

  const Ray& ray_W() const { return ray_W_; }
  /// No candidate beyond this is of interest any more.
  double reach() const { return best_t_; }
  bool is_shadow() const { return purpose_ == Purpose::kShadow; }
  bool has_hit() const { return placed_ != nullptr; }
  /// Whether the ray passes through that link: the sensor's own.
  bool passes(std::uint32_t entity, std::uint32_t link) const {
    return entity == own_entity_ && (link == own_link_ || own_link_ == kAllLinks);
  }

  /// Makes `placed` the body that the next calls speak of.
  void enter(const TraceableInstance& placed) {
    if (entered_ == &placed) return;
    entered_ = &placed;
    ray_B_ = placed.to_body(ray_W_);
  }
  const Ray& ray_B() const { return ray_B_; }

  /// All of the body, from t_low on.
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
  const TraceableInstance* placed_ = nullptr;  // what the nearest hit belongs to
  std::uint32_t surface_ = 0;
  std::uint32_t primitive_ = 0;
  std::uint32_t item_ = 0;
  Eigen::Vector3d normal_B_;
};

/// Rays that go through a scene together: neighbours of a pattern meet much the same boxes. Eight
/// are native from AVX2 on.
constexpr int kPacketRays = 8;

/// What Embree hands to our callbacks with each ray, whose id says which of the queries it serves.
struct TraversalContext {
  RTCIntersectContext embree;
  RayQuery* queries;
  double t_shift[kPacketRays];  // Embree's t is the world's t minus this
};

/// One query's way through a scene: the ray in the scene's frame and the stretch of it that
/// matters.
struct RaySegment {
  Ray ray;
  double t_low = 0.0;
  double t_high = -1.0;  // below t_low: the query stays out

  bool empty() const { return !(t_low <= t_high); }
};

/// Rays as Embree takes them: none at first.
struct RayPacket {
  RayPacket();

  alignas(32) int valid[kPacketRays];
  RTCRayHit8 rays;

  /// Ray `i` of the packet, in the scene's frame.
  void add(int i, const Ray& ray, double reach);
  /// False if all stay out.
  bool load(const RaySegment* passages);
};

void traverse(RTCSceneTy* scene, RayQuery& query, const RaySegment& passage);
/// `queries` and `passages` are kPacketRays long.
void traverse_packet(RTCSceneTy* scene, RayQuery* queries, const RaySegment* passages);

/// A float that is safely above the double.
inline float float_above(double t) { return static_cast<float>(t * (1.0 + 1e-6) + 1e-5); }

/// In a callback: the rays that Embree asks about. `intersect(query, rays, i, t_shift)` is called
/// for each, and Embree is told how near the nearest hit now is.
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

/// The callback of the scene over a body's primitives.
void intersect_primitive_of(const RTCIntersectFunctionNArguments* args);

}  // namespace ardee::raycast
