// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/draft_scene.h"

#include <algorithm>

namespace ardee {
namespace {

constexpr std::uint32_t kNotUsed = 0xFFFFFFFFu;

bool is_careful(const BodySurface& surface) {
  return surface.mask != nullptr || !surface.two_sided || !surface.casts_shadows;
}

}  // namespace

DraftScene::DraftScene(const EmbreeDevice& device, const std::vector<const PlacedBody*>& bodies,
                       const Eigen::Vector3d& origin_W)
    : bodies_(bodies), scene_(rtcNewScene(device.get())) {
  for (std::uint32_t k = 0; k < bodies_.size(); ++k) add(k, origin_W);
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

void DraftScene::add(std::uint32_t body_index, const Eigen::Vector3d& origin_W) {
  const PlacedBody& placed = *bodies_[body_index];
  const Body& body = *placed.body;
  const Eigen::Matrix3d turn = placed.q.toRotationMatrix() * placed.scale;
  const Eigen::Vector3d shift = placed.p - origin_W;
  std::vector<std::uint32_t> numbers[2];  // of the body's vertices in each part
  for (auto& each : numbers) each.assign(body.vertices.size(), kNotUsed);
  for (std::uint32_t t = 0; t < body.triangles.size(); ++t) {
    const BodyTriangle& triangle = body.triangles[t];
    const std::size_t kind = is_careful(body.surfaces[triangle.surface]) ? 1 : 0;
    Part& part = parts_[kind];
    part.owners.push_back({body_index, t});
    for (const std::uint32_t vertex : triangle.vertices) {
      std::uint32_t& number = numbers[kind][vertex];
      if (number == kNotUsed) {
        number = static_cast<std::uint32_t>(part.vertices.size());
        part.vertices.push_back(
            (shift + turn * body.vertices[vertex].cast<double>()).cast<float>());
      }
      part.corners.push_back(number);
    }
  }
}

void DraftScene::attach(const EmbreeDevice& device, Part& part, bool careful) {
  part.scene = this;
  if (part.owners.empty()) return;
  part.vertices.emplace_back(0, 0, 0);  // Embree reads sixteen bytes of the last one, too
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             part.vertices.data(), 0, sizeof(Eigen::Vector3f),
                             part.vertices.size() - 1);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             part.corners.data(), 0, 3 * sizeof(std::uint32_t), part.owners.size());
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
    const unsigned number = RTCHitN_primID(args->hit, n, i);
    const Owner& owner = part.owners[number];
    const Body& body = *part.scene->bodies_[owner.body]->body;
    const BodyTriangle& triangle = body.triangles[owner.triangle];
    const BodySurface& surface = body.surfaces[triangle.surface];
    bool kept = keep(part, surface, number, i);
    if (kept && surface.mask != nullptr) {
      const float u = RTCHitN_u(args->hit, n, i);
      const float v = RTCHitN_v(args->hit, n, i);
      const Eigen::Vector2f uv = (1.0f - u - v) * body.texcoords[triangle.vertices[0]] +
                                 u * body.texcoords[triangle.vertices[1]] +
                                 v * body.texcoords[triangle.vertices[2]];
      kept = !surface.mask->is_hole(uv.cast<double>());
    }
    if (!kept) args->valid[i] = 0;
  }
}

void DraftScene::sort_out_hits(const RTCFilterFunctionNArguments* args) {
  filter(args, [args](const Part& part, const BodySurface& surface, unsigned number, unsigned i) {
    if (surface.two_sided) return true;
    const std::uint32_t* corner = &part.corners[3 * static_cast<std::size_t>(number)];
    const Eigen::Vector3f& a = part.vertices[corner[0]];
    const Eigen::Vector3f normal =
        (part.vertices[corner[1]] - a).cross(part.vertices[corner[2]] - a);
    const unsigned n = args->N;
    return normal.x() * RTCRayN_dir_x(args->ray, n, i) +
               normal.y() * RTCRayN_dir_y(args->ray, n, i) +
               normal.z() * RTCRayN_dir_z(args->ray, n, i) <=
           0.0f;
  });
}

void DraftScene::sort_out_shadows(const RTCFilterFunctionNArguments* args) {
  filter(args, [](const Part&, const BodySurface& surface, unsigned, unsigned) {
    return surface.casts_shadows;
  });
}

void DraftScene::meet(RayQuery queries[kPacketRays], const Passage passages[kPacketRays],
                      bool undecided[kPacketRays]) const {
  RayPacket packet;
  std::fill_n(undecided, kPacketRays, false);
  if (!packet.load(passages)) return;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(packet.valid, scene_, &context, &packet.rays);
  for (int i = 0; i < kPacketRays; ++i) {
    if (packet.valid[i] == 0 || packet.rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    const Owner& owner = parts_[packet.rays.hit.geomID[i]].owners[packet.rays.hit.primID[i]];
    undecided[i] = !queries[i].meet_triangle_of(*bodies_[owner.body], owner.triangle);
  }
}

void DraftScene::meet_shadows(RayQuery queries[kPacketRays],
                              const Passage passages[kPacketRays]) const {
  RayPacket packet;
  if (!packet.load(passages)) return;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded8(packet.valid, scene_, &context, &packet.rays.ray);
  for (int i = 0; i < kPacketRays; ++i) {
    if (packet.valid[i] != 0 && packet.rays.ray.tfar[i] < 0.0f)
      queries[i].end_in_shadow(*bodies_[0]);
  }
}

std::size_t DraftScene::bytes() const {
  std::size_t sum = 0;
  for (const Part& part : parts_) {
    sum += part.owners.capacity() * sizeof(Owner) +
           part.vertices.capacity() * sizeof(Eigen::Vector3f) +
           part.corners.capacity() * sizeof(std::uint32_t);
  }
  return sum;
}

}  // namespace ardee
