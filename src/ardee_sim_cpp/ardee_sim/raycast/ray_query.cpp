// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/ray_query.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ardee::raycast {
namespace {

/// Reach of a finished query.
constexpr double kNothingMatters = -1.0;

}  // namespace

bool RayQuery::precedes(const Candidate& candidate) const {
  if (candidate.t != best_t_ || placed_ == nullptr) return candidate.t <= best_t_;
  const TraceableSurface& mine = entered_->body->surfaces[candidate.surface];
  const TraceableSurface& best = placed_->body->surfaces[surface_];
  return std::make_tuple(entered_->entity, mine.link, mine.shape, candidate.primitive) <
         std::make_tuple(placed_->entity, best.link, best.shape, primitive_);
}

void RayQuery::offer(const Candidate& candidate) {
  const TraceableSurface& surface = entered_->body->surfaces[candidate.surface];
  if (!precedes(candidate)) return;
  if (purpose_ == Purpose::kShadow) {
    if (!surface.casts_shadows) return;
    best_t_ = kNothingMatters;
    placed_ = entered_;
    return;
  }
  if (!surface.two_sided && candidate.normal_B.dot(ray_B_.direction) > 0.0) return;
  if (passes(entered_->entity, surface.link)) return;
  best_t_ = candidate.t;
  placed_ = entered_;
  surface_ = candidate.surface;
  primitive_ = candidate.primitive;
  item_ = candidate.item;
  normal_B_ = candidate.normal_B;
}

bool RayQuery::is_hole(const TraceableTriangle& triangle, const Eigen::Vector3d& weights) const {
  const Traceable& body = *entered_->body;
  Eigen::Vector2d uv(0, 0);
  for (std::size_t k = 0; k < 3; ++k) {
    uv +=
        weights[static_cast<Eigen::Index>(k)] * body.texcoords[triangle.vertices[k]].cast<double>();
  }
  return body.surfaces[triangle.surface].mask->is_hole(uv);
}

void RayQuery::intersect_marked(const TriangleBlock& block, std::uint32_t marks) {
  const Traceable& body = *entered_->body;
  for (std::uint32_t lane = 0; lane < block.count && marks >> lane != 0; ++lane) {
    if ((marks >> lane & 1u) == 0) continue;
    const TraceableTriangle& triangle = body.triangles[block.first + lane];
    TriangleHit hit;
    if (intersect_triangle(ray_B_, body.vertices[triangle.vertices[0]].cast<double>(),
                           body.vertices[triangle.vertices[1]].cast<double>(),
                           body.vertices[triangle.vertices[2]].cast<double>(), hit)) {
      if (body.surfaces[triangle.surface].mask != nullptr && is_hole(triangle, hit.weights)) {
        continue;
      }
      offer({hit.t, triangle.surface, triangle.primitive, block.first + lane, hit.normal});
    }
  }
}

void RayQuery::intersect_block(const TriangleBlock& block) {
  const double scale = ray_B_.direction.squaredNorm();
  const Eigen::Vector3d away = ray_B_.origin - block.center;
  const double t_near = -away.dot(ray_B_.direction) / scale;
  const Eigen::Vector3d origin = away + t_near * ray_B_.direction;
  const double t_radius = 2.0 * static_cast<double>(block.radius) / std::sqrt(scale) + 1e-3;
  BlockRay ray;
  for (int k = 0; k < 3; ++k) {
    ray.origin[k] = static_cast<float>(origin[k]);
    ray.direction[k] = static_cast<float>(ray_B_.direction[k]);
  }
  ray.t_low = static_cast<float>(std::max(-t_near, -t_radius));
  ray.t_high = static_cast<float>(std::min(best_t_ - t_near, t_radius));
  ray.slack_m = static_cast<float>(kBlockSlack * static_cast<double>(block.radius) +
                                   1e-7 * (1.0 + origin.norm()));
  intersect_marked(block, cull_conservatively(block, ray));
}

void RayQuery::intersect_solid(const AnalyticSolid& solid) {
  const auto item = static_cast<std::uint32_t>(&solid - entered_->body->solids.data());
  const Ray ray{solid.R_BS.transpose() * (ray_B_.origin - solid.p_BS),
                solid.R_BS.transpose() * ray_B_.direction};
  const bool two_sided = entered_->body->surfaces[solid.surface].two_sided;
  RayInterval chord;
  bool met = false;
  switch (solid.kind) {
    case AnalyticSolid::Kind::kSphere:
      met = intersect_sphere(ray, solid.half_m.x(), chord);
      break;
    case AnalyticSolid::Kind::kBox:
      met = intersect_box(ray, solid.half_m, chord);
      break;
    case AnalyticSolid::Kind::kCylinder:
      met = intersect_cylinder(ray, solid.half_m.x(), solid.half_m.z(), chord);
      break;
    case AnalyticSolid::Kind::kRectangle:
    case AnalyticSolid::Kind::kGround: {
      double t = 0.0;
      if (!intersect_ground(ray, t)) return;
      const Eigen::Vector2d point = ray.at(t).head<2>().cwiseAbs();
      const bool inside = point.x() <= solid.half_m.x() && point.y() <= solid.half_m.y();
      if (solid.kind == AnalyticSolid::Kind::kGround || inside) {
        offer({t, solid.surface, 0, item, solid.R_BS.col(2)});
      }
      return;
    }
  }
  if (!met) return;
  if (chord.t_in >= 0.0) {
    offer({chord.t_in, solid.surface, 0, item, solid.R_BS * chord.normal_in});
  } else if (two_sided && chord.t_out >= 0.0) {
    offer({chord.t_out, solid.surface, 0, item, solid.R_BS * chord.normal_out});
  }
}

void RayQuery::intersect_patch(const TerrainPatch& patch) {
  const Terrain& terrain = entered_->body->terrains[patch.terrain];
  const Ray ray{terrain.R_BS.transpose() * (ray_B_.origin - terrain.p_BS),
                terrain.R_BS.transpose() * ray_B_.direction};
  terrain.heights.intersect(
      patch.cells, ray, best_t_, [&](const TriangleHit& hit, std::uint32_t number) {
        offer({hit.t, terrain.surface, number, patch.terrain, terrain.R_BS * hit.normal});
      });
}

void RayQuery::intersect_primitive(const Primitive& primitive) {
  const Traceable& body = *entered_->body;
  switch (primitive.kind) {
    case Primitive::Kind::kBlock:
      intersect_block(body.blocks[primitive.index]);
      break;
    case Primitive::Kind::kSolid:
      intersect_solid(body.solids[primitive.index]);
      break;
    case Primitive::Kind::kPatch:
      intersect_patch(body.patches[primitive.index]);
      break;
  }
}

void RayQuery::intersect_traceable(const TraceableInstance& placed, double t_low) {
  enter(placed);
  const Traceable& body = *placed.body;
  if (body.scene == nullptr) {
    for (const Primitive& primitive : body.primitives) intersect_primitive(primitive);
    return;
  }
  // The ray starts at the body's bounding sphere, so that floats are of the body's size however far
  // the ray comes from.
  const Eigen::Vector3d away = body.bounds.center() - ray_B_.origin;
  const double scale = ray_B_.direction.squaredNorm();
  const double t_middle = away.dot(ray_B_.direction) / scale;
  const double t_radius = 1.01 * body.bounds.radius() / std::sqrt(scale) + 1e-3;
  traverse(body.scene->get(), *this,
           {ray_B_, std::max(t_low, t_middle - t_radius), std::min(best_t_, t_middle + t_radius)});
}

void RayQuery::fill(RayHit& hit) const {
  hit = RayHit{};
  if (placed_ == nullptr) {
    hit.range_m = std::numeric_limits<float>::infinity();
    return;
  }
  const TraceableSurface& surface = placed_->body->surfaces[surface_];
  hit.range_m = static_cast<float>(best_t_);
  hit.entity = placed_->entity;
  hit.link = surface.link;
  hit.shape = surface.shape;
  hit.label = placed_->label;
  hit.laser_retro = surface.laser_retro;
  hit.reflectivity = surface.reflectivity;
  Eigen::Vector3d normal_W = (placed_->q * normal_B_).normalized();
  if (normal_W.dot(ray_W_.direction) > 0.0) normal_W = -normal_W;
  hit.normal_W = normal_W.cast<float>();
}

void traverse(RTCSceneTy* scene, RayQuery& query, const RaySegment& passage) {
  if (passage.empty()) return;
  TraversalContext context;
  rtcInitIntersectContext(&context.embree);
  context.queries = &query;
  context.t_shift[0] = passage.t_low;
  const Eigen::Vector3f origin = passage.ray.at(passage.t_low).cast<float>();
  const Eigen::Vector3f direction = embree_direction(passage.ray.direction.cast<float>());
  RTCRayHit rayhit{};
  rayhit.ray.org_x = origin.x();
  rayhit.ray.org_y = origin.y();
  rayhit.ray.org_z = origin.z();
  rayhit.ray.dir_x = direction.x();
  rayhit.ray.dir_y = direction.y();
  rayhit.ray.dir_z = direction.z();
  rayhit.ray.tfar = float_above(passage.t_high - passage.t_low);
  rayhit.ray.mask = 0xFFFFFFFFu;
  rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rayhit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context.embree, &rayhit);
}

RayPacket::RayPacket() {
  for (int i = 0; i < kPacketRays; ++i) {
    valid[i] = 0;
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
}

void RayPacket::add(int i, const Ray& ray, double reach) {
  const Eigen::Vector3f origin = ray.origin.cast<float>();
  const Eigen::Vector3f direction = embree_direction(ray.direction.cast<float>());
  valid[i] = -1;
  rays.ray.org_x[i] = origin.x();
  rays.ray.org_y[i] = origin.y();
  rays.ray.org_z[i] = origin.z();
  rays.ray.dir_x[i] = direction.x();
  rays.ray.dir_y[i] = direction.y();
  rays.ray.dir_z[i] = direction.z();
  rays.ray.tnear[i] = 0.0f;
  rays.ray.time[i] = 0.0f;
  rays.ray.tfar[i] = float_above(reach);
  rays.ray.mask[i] = 0xFFFFFFFFu;
  rays.ray.id[i] = static_cast<unsigned>(i);
  rays.ray.flags[i] = 0;
}

bool RayPacket::load(const RaySegment* passages) {
  bool any = false;
  for (int i = 0; i < kPacketRays; ++i) {
    const RaySegment& passage = passages[i];
    if (passage.empty()) continue;
    any = true;
    add(i, {passage.ray.at(passage.t_low), passage.ray.direction}, passage.t_high - passage.t_low);
  }
  return any;
}

void traverse_packet(RTCSceneTy* scene, RayQuery* queries, const RaySegment* passages) {
  RayPacket packet;
  if (!packet.load(passages)) return;
  TraversalContext context;
  rtcInitIntersectContext(&context.embree);
  context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  context.queries = queries;
  for (int i = 0; i < kPacketRays; ++i) context.t_shift[i] = passages[i].t_low;
  rtcIntersect8(packet.valid, scene, &context.embree, &packet.rays);
}

void intersect_primitive_of(const RTCIntersectFunctionNArguments* args) {
  const Traceable& body = *static_cast<const Traceable*>(args->geometryUserPtr);
  const Primitive& primitive = body.primitives[args->primID];
  for_each_ray(args, [&](RayQuery& query, RTCRayN*, unsigned, double) {
    query.intersect_primitive(primitive);
    return true;
  });
}

}  // namespace ardee::raycast
