// SPDX-License-Identifier: MIT
#include "bench/raycast_reference.h"

#include <embree3/rtcore.h>

#include "ardee_sim/raycast/local_scene.h"
#include "ardee_sim/raycast/scenery_store.h"

namespace ardee::bench {
namespace {

/// Factor on the radius of a local scene, as in LocalSceneCache.
constexpr double kSpare = 1.5;

void attach(RTCDevice device, RTCScene scene, const Placement& placement) {
  const SubMesh& part =
      std::get<Mesh>(placement.model->links[0].visuals[0].geometry).file->parts[0];
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               part.vertices.size()));
  for (const Eigen::Vector3f& vertex : part.vertices) {
    const Eigen::Vector3d p_W = placement.X_WM * (placement.scale * vertex.cast<double>());
    for (int k = 0; k < 3; ++k) *vertices++ = static_cast<float>(p_W[k]);
  }
  auto* corners = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), part.triangles.size()));
  for (const auto& triangle : part.triangles) corners = std::copy_n(triangle.data(), 3, corners);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

}  // namespace

struct BareRegion::Impl {
  Impl(const std::vector<Placement>& field, const Eigen::Vector3d& eye,
       const raycast::RayOptions& options)
      : store(raycast::SceneKind::kVisual, log) {
    store.add(0, field);
    store.commit();
    if (!options.local_scenes) return;
    local = std::make_unique<raycast::LocalScene>(
        store.fixed(), raycast::StillInstances{},
        raycast::LocalSceneRequest{eye.head<2>(),
                                   kSpare * options.local_scene_radius_m,
                                   {options.local_scene_budget_bytes}});
  }

  Log log;
  raycast::SceneryStore store;
  std::unique_ptr<raycast::LocalScene> local;
};

BareRegion::BareRegion(const std::vector<Placement>& field, const Eigen::Vector3d& eye,
                       const raycast::RayOptions& options)
    : impl_(std::make_unique<Impl>(field, eye, options)) {}

BareRegion::~BareRegion() = default;

void BareRegion::cast(const Pose& X_WS, const raycast::RayPattern& pattern,
                      float max_range_m) const {
  const auto& directions = pattern.directions_S;
  for (std::size_t i = 0; i < directions.size(); i += raycast::kPacketRays) {
    raycast::RayQuery queries[raycast::kPacketRays];
    double t_high[raycast::kPacketRays];
    double t_low[raycast::kPacketRays];
    for (std::size_t k = 0; k < raycast::kPacketRays; ++k) {
      const auto& direction = directions[std::min(i + k, directions.size() - 1)];
      queries[k].start({X_WS.p, X_WS.q * direction.cast<double>()}, max_range_m, raycast::kNoEntity,
                       0);
      t_high[k] = i + k < directions.size() ? static_cast<double>(max_range_m) : -1.0;
      t_low[k] = t_high[k] < 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
    }
    if (impl_->local != nullptr) {
      impl_->local->intersect(queries, t_high);
    } else {
      impl_->store.fixed()->places().intersect(queries, t_low);
    }
  }
}

struct FlatField::Impl {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);

  ~Impl() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
};

FlatField::FlatField(const std::vector<Placement>& field, double half_size_m)
    : impl_(std::make_unique<Impl>()) {
  for (const Placement& placement : field) {
    if (placement.X_WM.p.head<2>().cwiseAbs().maxCoeff() > half_size_m) continue;
    attach(impl_->device, impl_->scene, placement);
  }
  rtcCommitScene(impl_->scene);
}

FlatField::~FlatField() = default;

void FlatField::cast(const Pose& X_WS, const raycast::RayPattern& pattern,
                     float max_range_m) const {
  const Eigen::Vector3f origin = X_WS.p.cast<float>();
  const Eigen::Matrix3f R_WS = X_WS.q.toRotationMatrix().cast<float>();
  for (const Eigen::Vector3f& direction_S : pattern.directions_S) {
    const Eigen::Vector3f direction = R_WS * direction_S;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit rayhit{};
    rayhit.ray.org_x = origin.x();
    rayhit.ray.org_y = origin.y();
    rayhit.ray.org_z = origin.z();
    rayhit.ray.dir_x = direction.x();
    rayhit.ray.dir_y = direction.y();
    rayhit.ray.dir_z = direction.z();
    rayhit.ray.tfar = max_range_m;
    rayhit.ray.mask = 0xFFFFFFFFu;
    rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(impl_->scene, &context, &rayhit);
  }
}

}  // namespace ardee::bench
