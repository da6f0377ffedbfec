// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/draft_scene.h"

#include <algorithm>
#include <cmath>

namespace ardee {
namespace {

/// Rays of a picture that go together.
constexpr int kGlances = 16;
constexpr std::uint32_t kNotUsed = 0xFFFFFFFFu;

bool is_careful(const BodySurface& surface) {
  return surface.mask != nullptr || !surface.two_sided || !surface.casts_shadows;
}

/// Ground is met from below, too: nobody takes a picture of it from there.
bool is_careful_ground(const BodySurface& surface) { return !surface.casts_shadows; }

float cross(const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool has_texcoords(const BodySurface& surface) {
  return surface.part != nullptr && surface.part->texcoords.size() == surface.part->vertices.size();
}

/// In the body; zero where the mesh has none.
Eigen::Vector3d normal_of(const BodySurface& surface, std::uint32_t vertex) {
  if (surface.part == nullptr || surface.part->normals.size() != surface.part->vertices.size()) {
    return Eigen::Vector3d::Zero();
  }
  const Eigen::Vector3f& of_part = surface.part->normals[vertex - surface.first_vertex];
  const Eigen::Vector3d normal = surface.normals_to_body * of_part.cast<double>();
  const double length = normal.norm();
  if (!(length > 0.0) || !std::isfinite(length)) return Eigen::Vector3d::Zero();
  return normal / length;
}

}  // namespace

DraftScene::DraftScene(const EmbreeDevice& device, const std::vector<DraftBody>& bodies,
                       const Eigen::Vector3d& origin_W)
    : bodies_(bodies), origin_W_(origin_W), scene_(rtcNewScene(device.get())) {
  for (std::uint32_t k = 0; k < bodies_.size(); ++k) {
    add_triangles(k, origin_W);
    for (const std::uint32_t patch : bodies_[k].patches) {
      add_patch(k, bodies_[k].placed->body->patches[patch], origin_W);
    }
  }
  for (const bool careful : {false, true}) attach(device, parts_[careful ? 1 : 0], careful);
  rtcCommitScene(scene_);
  try {
    device.check();
  } catch (...) {
    rtcReleaseScene(scene_);
    throw;
  }
}

DraftScene::~DraftScene() { rtcReleaseScene(scene_); }

void DraftScene::add_triangles(std::uint32_t body_index, const Eigen::Vector3d& origin_W) {
  const PlacedBody& placed = *bodies_[body_index].placed;
  const Body& body = *placed.body;
  const Eigen::Matrix3d R_WB = placed.q.toRotationMatrix();
  const Eigen::Vector3d shift = placed.p - origin_W;
  std::vector<std::uint32_t> numbers[2];  // of the body's vertices in each part
  for (auto& each : numbers) each.assign(body.vertices.size(), kNotUsed);
  for (const BodyTriangle& from : body.triangles) {
    const BodySurface& surface = body.surfaces[from.surface];
    const std::size_t kind = is_careful(surface) ? 1 : 0;
    Part& part = parts_[kind];
    Triangle triangle{{}, body_index, from.surface, kNoTerrain, 0.0f};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = from.vertices[k];
      std::uint32_t& number = numbers[kind][vertex];
      if (number == kNotUsed) {
        number = static_cast<std::uint32_t>(part.places.size());
        const Eigen::Vector3d place_B = body.vertices[vertex].cast<double>();
        part.places.push_back((shift + R_WB * (placed.scale * place_B)).cast<float>());
        Vertex made;
        made.normal = (R_WB * normal_of(surface, vertex)).cast<float>();
        if (has_texcoords(surface)) {
          made.uv = surface.part->texcoords[vertex - surface.first_vertex];
        }
        part.vertices.push_back(made);
      }
      triangle.corners[k] = number;
    }
    if (has_texcoords(surface)) {
      const std::uint32_t* corners = triangle.corners;
      const Eigen::Vector3f& a = part.places[corners[0]];
      const Eigen::Vector2f& uv = part.vertices[corners[0]].uv;
      const float area = (part.places[corners[1]] - a).cross(part.places[corners[2]] - a).norm();
      const float on_texture =
          cross(part.vertices[corners[1]].uv - uv, part.vertices[corners[2]].uv - uv);
      triangle.uv_per_m = std::max(std::sqrt(std::abs(on_texture) / area), 1e-12f);
    }
    part.triangles.push_back(triangle);
  }
}

void DraftScene::add_patch(std::uint32_t body_index, const TerrainPatch& patch,
                           const Eigen::Vector3d& origin_W) {
  const PlacedBody& placed = *bodies_[body_index].placed;
  const Terrain& terrain = placed.body->terrains[patch.terrain];
  const Eigen::Matrix3d R_WB = placed.q.toRotationMatrix();
  Part& part = parts_[is_careful_ground(placed.body->surfaces[terrain.surface]) ? 1 : 0];
  const auto first = static_cast<std::uint32_t>(part.places.size());
  const HeightPatch& cells = patch.cells;
  for (int row = cells.row; row <= cells.row + cells.rows; ++row) {
    for (int column = cells.column; column <= cells.column + cells.columns; ++column) {
      const Eigen::Vector3d place_S = terrain.heights.vertex(column, row);
      const Eigen::Vector3d place_B = terrain.p_BS + terrain.R_BS * place_S;
      const Eigen::Vector3d normal_S = terrain.heights.smooth_normal(place_S.head<2>());
      part.places.push_back((placed.p - origin_W + R_WB * (placed.scale * place_B)).cast<float>());
      part.vertices.push_back({(R_WB * (terrain.R_BS * normal_S)).cast<float>(), {0, 0}});
    }
  }
  const auto columns = static_cast<std::uint32_t>(cells.columns);
  for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(cells.rows); ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t v00 = first + row * (columns + 1) + column;
      const std::uint32_t v01 = v00 + columns + 1;
      const Triangle lower{
          {v00, v00 + 1, v01 + 1}, body_index, terrain.surface, patch.terrain, 0.0f};
      const Triangle upper{{v00, v01 + 1, v01}, body_index, terrain.surface, patch.terrain, 0.0f};
      part.triangles.push_back(lower);
      part.triangles.push_back(upper);
    }
  }
}

void DraftScene::attach(const EmbreeDevice& device, Part& part, bool careful) {
  part.scene = this;
  if (part.triangles.empty()) return;
  part.places.emplace_back(0, 0, 0);  // Embree reads sixteen bytes of the last one, too
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             part.places.data(), 0, sizeof(Eigen::Vector3f),
                             part.places.size() - 1);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             part.triangles.data(), 0, sizeof(Triangle), part.triangles.size());
  if (careful) {
    rtcSetGeometryUserData(geometry, &part);
    rtcSetGeometryIntersectFilterFunction(geometry, &DraftScene::sort_out_hits);
    rtcSetGeometryOccludedFilterFunction(geometry, &DraftScene::sort_out_shadows);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene_, geometry, careful ? 1 : 0);
  rtcReleaseGeometry(geometry);
}

template <typename Keep>
void DraftScene::filter(const RTCFilterFunctionNArguments* args, const Keep& keep) {
  const Part& part = *static_cast<const Part*>(args->geometryUserPtr);
  const unsigned n = args->N;
  for (unsigned i = 0; i < n; ++i) {
    if (args->valid[i] == 0) continue;
    const Triangle& triangle = part.triangles[RTCHitN_primID(args->hit, n, i)];
    const Body& body = *part.scene->bodies_[triangle.body].placed->body;
    const BodySurface& surface = body.surfaces[triangle.surface];
    bool kept = keep(part, surface, triangle, i);
    if (kept && surface.mask != nullptr) {
      const float u = RTCHitN_u(args->hit, n, i);
      const float v = RTCHitN_v(args->hit, n, i);
      const Eigen::Vector2f uv = (1.0f - u - v) * part.vertices[triangle.corners[0]].uv +
                                 u * part.vertices[triangle.corners[1]].uv +
                                 v * part.vertices[triangle.corners[2]].uv;
      kept = !surface.mask->is_hole(uv.cast<double>());
    }
    if (!kept) args->valid[i] = 0;
  }
}

void DraftScene::sort_out_hits(const RTCFilterFunctionNArguments* args) {
  filter(args, [args](const Part& part, const BodySurface& surface, const Triangle& triangle,
                      unsigned i) {
    if (surface.two_sided) return true;
    const Eigen::Vector3f& a = part.places[triangle.corners[0]];
    const Eigen::Vector3f normal =
        (part.places[triangle.corners[1]] - a).cross(part.places[triangle.corners[2]] - a);
    const unsigned n = args->N;
    return normal.x() * RTCRayN_dir_x(args->ray, n, i) +
               normal.y() * RTCRayN_dir_y(args->ray, n, i) +
               normal.z() * RTCRayN_dir_z(args->ray, n, i) <=
           0.0f;
  });
}

void DraftScene::sort_out_shadows(const RTCFilterFunctionNArguments* args) {
  filter(args, [](const Part&, const BodySurface& surface, const Triangle&, unsigned) {
    return surface.casts_shadows;
  });
}

void DraftScene::meet(RayPacket& packet) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(packet.valid, scene_, &context, &packet.rays);
}

void DraftScene::find_shadows(RayPacket& packet) const {
  // From points on leaves near and far: not coherent.
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded8(packet.valid, scene_, &context, &packet.rays.ray);
}

void DraftScene::glance(const Eigen::Vector3f& eye, const GlanceRay* rays, int count,
                        Glance* glances) const {
  alignas(64) int valid[kGlances];
  RTCRayHit16 packet;
  for (int i = 0; i < kGlances; ++i) {
    const GlanceRay& ray = rays[std::min(i, count - 1)];
    valid[i] = i < count ? -1 : 0;
    packet.ray.org_x[i] = eye.x();
    packet.ray.org_y[i] = eye.y();
    packet.ray.org_z[i] = eye.z();
    packet.ray.dir_x[i] = ray.direction_W.x();
    packet.ray.dir_y[i] = ray.direction_W.y();
    packet.ray.dir_z[i] = ray.direction_W.z();
    packet.ray.tnear[i] = ray.near_m;
    packet.ray.tfar[i] = ray.far_m;
    packet.ray.time[i] = 0.0f;
    packet.ray.mask[i] = 0xFFFFFFFFu;
    packet.ray.id[i] = static_cast<unsigned>(i);
    packet.ray.flags[i] = 0;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, scene_, &context, &packet);
  for (int i = 0; i < count; ++i) {
    Glance& glance = glances[i];
    glance = Glance{};
    const std::uint32_t geometry = packet.hit.geomID[i];
    if (geometry == RTC_INVALID_GEOMETRY_ID) continue;
    const Triangle& triangle = parts_[geometry].triangles[packet.hit.primID[i]];
    glance.surface = (std::uint64_t{triangle.body} + 1) << 32 | triangle.surface;
    glance.range_m = packet.ray.tfar[i];
    glance.normal_W = {packet.hit.Ng_x[i], packet.hit.Ng_y[i], packet.hit.Ng_z[i]};
    glance.geometry = geometry;
    glance.primitive = packet.hit.primID[i];
  }
}

DraftScene::Meeting DraftScene::meeting(const Part& part, const Triangle& triangle,
                                        const Met& met) {
  // Moeller and Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997.
  const Eigen::Vector3f& a = part.places[triangle.corners[0]];
  const Eigen::Vector3f ab = part.places[triangle.corners[1]] - a;
  const Eigen::Vector3f ac = part.places[triangle.corners[2]] - a;
  const Eigen::Vector3f from_a = met.origin - a;
  Meeting result;
  result.normal = ab.cross(ac);
  const float share = -1.0f / met.direction.dot(result.normal);
  const Eigen::Vector3f across = from_a.cross(met.direction);
  result.t = share * from_a.dot(result.normal);
  result.u = share * ac.dot(across);
  result.v = -share * ab.dot(across);
  if (!std::isfinite(share)) {  // along the triangle: its middle
    result.u = result.v = 1.0f / 3.0f;
    result.t = ((ab + ac) / 3.0f - from_a).dot(met.direction);
  }
  return result;
}

void DraftScene::fill(const Met& met, SurfacePoint& point) const {
  const Part& part = parts_[met.geometry];
  const Triangle& triangle = part.triangles[met.primitive];
  const PlacedBody& placed = *bodies_[triangle.body].placed;
  const BodySurface& surface = placed.body->surfaces[triangle.surface];
  const Meeting meets = meeting(part, triangle, met);
  const Vertex* corners[3];
  for (int k = 0; k < 3; ++k) corners[k] = &part.vertices[triangle.corners[k]];
  const float w = 1.0f - meets.u - meets.v;
  Eigen::Vector3f normal = meets.normal.normalized();
  if (normal.dot(met.direction) > 0.0f) normal = -normal;
  Eigen::Vector3f smooth =
      w * corners[0]->normal + meets.u * corners[1]->normal + meets.v * corners[2]->normal;
  const float length = smooth.norm();
  smooth = length > 1e-3f ? Eigen::Vector3f(smooth / length) : normal;
  if (smooth.dot(normal) < 0.0f) smooth = -smooth;
  point.range_m = meets.t;
  point.entity = placed.entity;
  point.link = surface.link;
  point.shape = surface.shape;
  point.label = placed.label;
  point.visual = surface.visual;
  point.material = surface.material;
  point.two_sided = surface.two_sided;
  point.normal_W = normal.cast<double>();
  point.smooth_normal_W = smooth.cast<double>();
  point.uv =
      (w * corners[0]->uv + meets.u * corners[1]->uv + meets.v * corners[2]->uv).cast<double>();
  point.uv_per_m = triangle.uv_per_m;
  point.point_S.setZero();
  if (triangle.terrain == kNoTerrain) return;
  const Terrain& terrain = placed.body->terrains[triangle.terrain];
  const Eigen::Vector3f at = met.origin + meets.t * met.direction;
  const Eigen::Vector3d at_B =
      placed.q.conjugate() * (at.cast<double>() + origin_W_ - placed.p) / placed.scale;
  point.point_S = terrain.R_BS.transpose() * (at_B - terrain.p_BS);
}

std::size_t DraftScene::bytes() const {
  std::size_t sum = 0;
  for (const Part& part : parts_) {
    sum += part.triangles.capacity() * sizeof(Triangle) +
           part.places.capacity() * sizeof(Eigen::Vector3f) +
           part.vertices.capacity() * sizeof(Vertex);
  }
  return sum;
}

}  // namespace ardee
