// SPDX-License-Identifier: MIT
#include "bench/raycast_reference.h"

#include <embree3/rtcore.h>

#include "ardee_sim/raycast/near_region.h"

namespace ardee::bench {
namespace {

/// As NearRegions makes it: half as much again as the radius asked for.
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
  Impl(const std::vector<Placement>& field, const Eigen::Vector3d& eye, const RayOptions& options)
      : store(device, masks, SceneKind::kVisual) {
    store.add(0, field);
    store.commit();
    if (!options.flatten) return;
    region = std::make_unique<NearRegion>(device, store, StillBodies{}, eye.head<2>(),
                                          kSpare * options.flattened_radius_m,
                                          RegionBudget{options.flattened_budget_bytes});
  }

  EmbreeDevice device;
  AlphaMasks masks{Log()};
  SceneryStore store;
  std::unique_ptr<NearRegion> region;
};

BareRegion::BareRegion(const std::vector<Placement>& field, const Eigen::Vector3d& eye,
                       const RayOptions& options)
    : impl_(std::make_unique<Impl>(field, eye, options)) {}

BareRegion::~BareRegion() = default;

void BareRegion::cast(const Pose& X_WS, const RayPattern& pattern, float max_range_m) const {
  const auto& directions = pattern.directions_S;
  for (std::size_t i = 0; i < directions.size(); i += kPacketRays) {
    RayQuery queries[kPacketRays];
    double t_high[kPacketRays];
    double t_low[kPacketRays];
    for (std::size_t k = 0; k < kPacketRays; ++k) {
      const auto& direction = directions[std::min(i + k, directions.size() - 1)];
      queries[k].start({X_WS.p, X_WS.q * direction.cast<double>()}, max_range_m, kNoEntity, 0);
      t_high[k] = i + k < directions.size() ? static_cast<double>(max_range_m) : -1.0;
      t_low[k] = t_high[k] < 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
    }
    if (impl_->region != nullptr) {
      impl_->region->meet(queries, t_high);
    } else {
      impl_->store.places().meet(queries, t_low);
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

void FlatField::cast(const Pose& X_WS, const RayPattern& pattern, float max_range_m) const {
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
