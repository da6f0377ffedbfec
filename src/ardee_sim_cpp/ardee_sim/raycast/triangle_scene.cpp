// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/triangle_scene.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace ardee::raycast {
namespace {

constexpr std::uint32_t kNotUsed = 0xFFFFFFFFu;

bool is_careful(const TraceableSurface& surface) {
  return surface.mask != nullptr || !surface.two_sided || !surface.casts_shadows;
}

/// Returns whether hits on the ground need a test; hits from below need none, since no picture is
/// taken from there.
bool is_careful_ground(const TraceableSurface& surface) { return !surface.casts_shadows; }

std::uint64_t next_number() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

float cross(const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool has_texcoords(const TraceableSurface& surface) {
  return surface.part != nullptr && surface.part->texcoords.size() == surface.part->vertices.size();
}

/// Vertex normal in the body; zero for a mesh without normals.
Eigen::Vector3d normal_of(const TraceableSurface& surface, std::uint32_t vertex) {
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

TriangleScene::TriangleScene(const std::vector<TriangleSource>& bodies,
                             const Eigen::Vector3d& origin_W, std::uint64_t time)
    : number_(next_number()),
      origin_W_(origin_W),
      time_(time),
      scene_(rtcNewScene(embree_device())) {
  for (const TriangleSource& body : bodies) {
    add_triangles(body);
    for (const std::uint32_t patch : body.patches) {
      add_patch(*body.placed, body.placed->body->patches[patch]);
    }
  }
  for (const bool careful : {false, true}) attach(parts_[careful ? 1 : 0], careful);
  // Without this flag, some rays at a common side of two triangles pass between them.
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  rtcCommitScene(scene_);
  try {
    check_embree();
  } catch (...) {
    rtcReleaseScene(scene_);
    throw;
  }
}

TriangleScene::~TriangleScene() { rtcReleaseScene(scene_); }

void TriangleScene::add_triangles(const TriangleSource& triangle_scene) {
  const TraceableInstance& placed = *triangle_scene.placed;
  const Traceable& body = *placed.body;
  const auto first_surface = static_cast<std::uint32_t>(surfaces_.size());
  for (const TraceableSurface& surface : body.surfaces) {
    surfaces_.push_back({&placed, &surface, nullptr, triangle_scene.moved_at});
  }
  const Eigen::Matrix3d R_WB = placed.q.toRotationMatrix();
  const Eigen::Vector3d shift = placed.p - origin_W_;
  std::vector<std::uint32_t> numbers[2];  // indices of the body's vertices in each part
  for (auto& each : numbers) each.assign(body.vertices.size(), kNotUsed);
  for (const TraceableTriangle& from : body.triangles) {
    const TraceableSurface& surface = body.surfaces[from.surface];
    const std::size_t kind = is_careful(surface) || triangle_scene.moved_at != nullptr ? 1 : 0;
    Part& part = parts_[kind];
    Triangle triangle{};
    triangle.surface = first_surface + from.surface;
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
    measure(part, triangle);
    part.triangles.push_back(triangle);
  }
}

void TriangleScene::add_patch(const TraceableInstance& placed, const TerrainPatch& patch) {
  const Terrain& terrain = placed.body->terrains[patch.terrain];
  const Eigen::Matrix3d R_WB = placed.q.toRotationMatrix();
  const TraceableSurface& ground = placed.body->surfaces[terrain.surface];
  // Patches of one terrain are one surface, and are adjacent.
  if (surfaces_.empty() || surfaces_.back().terrain != &terrain ||
      surfaces_.back().placed != &placed) {
    surfaces_.push_back({&placed, &ground, &terrain, nullptr});
  }
  const auto surface = static_cast<std::uint32_t>(surfaces_.size() - 1);
  Part& part = parts_[is_careful_ground(ground) ? 1 : 0];
  const auto first = static_cast<std::uint32_t>(part.places.size());
  const HeightPatch& cells = patch.cells;
  for (int row = cells.row; row <= cells.row + cells.rows; ++row) {
    for (int column = cells.column; column <= cells.column + cells.columns; ++column) {
      const Eigen::Vector3d place_S = terrain.heights.vertex(column, row);
      const Eigen::Vector3d place_B = terrain.p_BS + terrain.R_BS * place_S;
      const Eigen::Vector3d normal_S = terrain.heights.smooth_normal(place_S.head<2>());
      part.places.push_back((placed.p - origin_W_ + R_WB * (placed.scale * place_B)).cast<float>());
      part.vertices.push_back({(R_WB * (terrain.R_BS * normal_S)).cast<float>(), {0, 0}});
    }
  }
  const int stride = cells.columns + 1;
  for (int row = 0; row < cells.rows; ++row) {
    for (int column = 0; column < cells.columns; ++column) {
      for (const auto& cut : HeightMesh::kCut) {
        Triangle triangle{};
        std::transform(std::begin(cut), std::end(cut), triangle.corners, [&](const auto& corner) {
          const int vertex = (row + corner.row) * stride + column + corner.column;
          return first + static_cast<std::uint32_t>(vertex);
        });
        triangle.surface = surface;
        measure(part, triangle);
        part.triangles.push_back(triangle);
      }
    }
  }
}

/// Turns the corners so that the longest side comes first.
void TriangleScene::measure(Part& part, Triangle& triangle) {
  const auto side = [&](int k) -> Eigen::Vector3f {
    return part.places[triangle.corners[(k + 1) % 3]] - part.places[triangle.corners[k]];
  };
  int longest = 0;
  for (const int k : {1, 2}) {
    if (side(k).squaredNorm() > side(longest).squaredNorm()) longest = k;
  }
  std::rotate(triangle.corners, triangle.corners + longest, triangle.corners + 3);
  const Eigen::Vector3f base = side(0);
  const Eigen::Vector3f to_top = -side(2);
  triangle.texels = TriangleTexels(base, to_top);
}

void TriangleScene::attach(Part& part, bool careful) {
  part.scene = this;
  if (part.triangles.empty()) return;
  part.places.emplace_back(0, 0, 0);  // Embree reads sixteen bytes of the last one, too
  RTCGeometry geometry = rtcNewGeometry(embree_device(), RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             part.places.data(), 0, sizeof(Eigen::Vector3f),
                             part.places.size() - 1);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             part.triangles.data(), 0, sizeof(Triangle), part.triangles.size());
  if (careful) {
    rtcSetGeometryUserData(geometry, &part);
    rtcSetGeometryIntersectFilterFunction(geometry, &TriangleScene::cull_conservatively_hits);
    rtcSetGeometryOccludedFilterFunction(geometry, &TriangleScene::cull_conservatively_shadows);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene_, geometry, careful ? 1 : 0);
  rtcReleaseGeometry(geometry);
}

template <typename Keep>
void TriangleScene::filter(const RTCFilterFunctionNArguments* args, const Keep& keep) {
  const Part& part = *static_cast<const Part*>(args->geometryUserPtr);
  const unsigned n = args->N;
  for (unsigned i = 0; i < n; ++i) {
    if (args->valid[i] == 0) continue;
    const Triangle& triangle = part.triangles[RTCHitN_primID(args->hit, n, i)];
    const Surface& of_scene = part.scene->surfaces_[triangle.surface];
    const TraceableSurface& surface = *of_scene.of_body;
    const bool gone = of_scene.moved_at != nullptr && *of_scene.moved_at > part.scene->time_;
    bool kept = !gone && keep(part, surface, triangle, i);
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

void TriangleScene::cull_conservatively_hits(const RTCFilterFunctionNArguments* args) {
  filter(args, [args](const Part& part, const TraceableSurface& surface, const Triangle& triangle,
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

void TriangleScene::cull_conservatively_shadows(const RTCFilterFunctionNArguments* args) {
  filter(args, [](const Part&, const TraceableSurface& surface, const Triangle&, unsigned) {
    return surface.casts_shadows;
  });
}

void TriangleScene::intersect(RayPacket& packet) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(packet.valid, scene_, &context, &packet.rays);
}

void TriangleScene::find_shadows(RayPacket& packet) const {
  // The rays start on points of leaves near and far, so they are not coherent.
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded8(packet.valid, scene_, &context, &packet.rays.ray);
}

void TriangleScene::trace_primary(const Eigen::Vector3f& eye, PrimaryRayPacket& block) const {
  constexpr int kRays = PrimaryRayPacket::kRays;
  alignas(64) int valid[kRays];
  RTCRayHit16 packet;
  for (int i = 0; i < kRays; ++i) {
    const Eigen::Vector3f direction = embree_direction(block.direction_W(i));
    valid[i] = -1;
    packet.ray.org_x[i] = eye.x();
    packet.ray.org_y[i] = eye.y();
    packet.ray.org_z[i] = eye.z();
    packet.ray.dir_x[i] = direction.x();
    packet.ray.dir_y[i] = direction.y();
    packet.ray.dir_z[i] = direction.z();
    packet.ray.tnear[i] = block.near_m[i];
    packet.ray.tfar[i] = block.far_m[i];
    packet.ray.time[i] = 0.0f;
    packet.ray.mask[i] = 0xFFFFFFFFu;
    packet.ray.flags[i] = 0;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.u[i] = packet.hit.v[i] = 0.0f;
    packet.hit.Ng_x[i] = packet.hit.Ng_y[i] = packet.hit.Ng_z[i] = 0.0f;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, scene_, &context, &packet);
  for (int i = 0; i < kRays; ++i) {
    const float x = packet.hit.Ng_x[i];
    const float y = packet.hit.Ng_y[i];
    const float z = packet.hit.Ng_z[i];
    const float share = 1.0f / std::max(std::sqrt(x * x + y * y + z * z), 1e-30f);
    block.normal_x_W[i] = share * x;
    block.normal_y_W[i] = share * y;
    block.normal_z_W[i] = share * z;
  }
  for (int i = 0; i < kRays; ++i) {
    const std::uint32_t geometry = packet.hit.geomID[i];
    const bool met = geometry != RTC_INVALID_GEOMETRY_ID;
    block.surface[i] = PrimaryRayPacket::kNothing;
    block.triangle[i] = 0;
    block.u[i] = packet.hit.u[i];
    block.v[i] = packet.hit.v[i];
    block.range_m[i] = std::numeric_limits<float>::infinity();
    if (!met) continue;
    const std::uint32_t primitive = packet.hit.primID[i];
    block.surface[i] =
        PrimaryRayPacket::kFirstSurface + parts_[geometry].triangles[primitive].surface;
    block.triangle[i] = triangle_of(geometry, primitive);
    block.range_m[i] = packet.ray.tfar[i];
  }
}

TriangleScene::Meeting TriangleScene::meeting(const Part& part, const Triangle& triangle,
                                              const Met& met) {
  // Möller and Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997.
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
  if (!std::isfinite(share)) {  // the ray lies in the triangle's plane: take its middle
    result.u = result.v = 1.0f / 3.0f;
    result.t = ((ab + ac) / 3.0f - from_a).dot(met.direction);
  }
  return result;
}

void TriangleScene::fill(const Met& met, SurfaceInteraction& point) const {
  const auto [part, triangle] = find(met.triangle);
  const Meeting meets = meeting(part, triangle, met);
  fill(part, triangle, meets, met.direction, met.origin + meets.t * met.direction, point);
}

void TriangleScene::fill(const Part& part, const Triangle& triangle, const Meeting& meets,
                         const Eigen::Vector3f& direction, const Eigen::Vector3f& at,
                         SurfaceInteraction& point) const {
  const Surface& of_scene = surfaces_[triangle.surface];
  const TraceableInstance& placed = *of_scene.placed;
  const TraceableSurface& surface = *of_scene.of_body;
  const Vertex* corners[3];
  for (int k = 0; k < 3; ++k) corners[k] = &part.vertices[triangle.corners[k]];
  const float w = 1.0f - meets.u - meets.v;
  Eigen::Vector3f normal = meets.normal.normalized();
  if (normal.dot(direction) > 0.0f) normal = -normal;
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
  if (of_scene.terrain == nullptr) return;
  const Terrain& terrain = *of_scene.terrain;
  const Eigen::Vector3d at_B =
      placed.q.conjugate() * (at.cast<double>() + origin_W_ - placed.p) / placed.scale;
  point.point_S = terrain.R_BS.transpose() * (at_B - terrain.p_BS);
}

SurfaceTexel TriangleScene::texel(const TexelRequest& request) const {
  return find(request.triangle).second.texels.texel(request);
}

void TriangleScene::fill(const SurfaceTexel& texel, Eigen::Vector3f& at,
                         SurfaceInteraction& point) const {
  const auto [part, triangle] = find(texel.triangle);
  const Eigen::Vector3f& a = part.places[triangle.corners[0]];
  const Eigen::Vector3f ab = part.places[triangle.corners[1]] - a;
  const Eigen::Vector3f ac = part.places[triangle.corners[2]] - a;
  Meeting middle;
  triangle.texels.middle(texel, middle.u, middle.v);
  middle.t = 0.0f;
  middle.normal = ab.cross(ac);
  at = a + middle.u * ab + middle.v * ac;
  fill(part, triangle, middle, texel.from_behind ? middle.normal : -middle.normal, at, point);
}

std::size_t TriangleScene::bytes() const {
  std::size_t sum = surfaces_.capacity() * sizeof(Surface);
  for (const Part& part : parts_) {
    sum += part.triangles.capacity() * sizeof(Triangle) +
           part.places.capacity() * sizeof(Eigen::Vector3f) +
           part.vertices.capacity() * sizeof(Vertex);
  }
  return sum;
}

}  // namespace ardee::raycast
