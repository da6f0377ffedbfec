// SPDX-License-Identifier: MIT
#include "bench/embree_reference.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "ardee_sim/core/error.h"

namespace ardee::bench {
namespace {

bool is_ground(const Model& model) {
  return std::any_of(model.links.begin(), model.links.end(), [](const Link& link) {
    return std::any_of(link.visuals.begin(), link.visuals.end(), [](const Visual& visual) {
      return !std::holds_alternative<Mesh>(visual.geometry);
    });
  });
}

double distance_m(const Placement& placement, const Eigen::Vector2d& center) {
  return (placement.X_WM.p.head<2>() - center).norm();
}

}  // namespace

std::vector<Placement> scenery(const Simulation& simulation) {
  std::vector<Placement> all;
  for (const auto& entity : simulation.entities()) {
    all.insert(all.end(), entity->placements.begin(), entity->placements.end());
  }
  return all;
}

EmbreeReference::EmbreeReference() : device_(rtcNewDevice("threads=1")) {
  if (!device_) throw Error("Embree: no device");
  scene_ = rtcNewScene(device_);
}

EmbreeReference::EmbreeReference(EmbreeReference&& other) noexcept
    : device_(std::exchange(other.device_, nullptr)),
      scene_(std::exchange(other.scene_, nullptr)),
      triangle_count_(other.triangle_count_) {}

EmbreeReference::~EmbreeReference() {
  if (scene_) rtcReleaseScene(scene_);
  if (device_) rtcReleaseDevice(device_);
}

EmbreeReference EmbreeReference::flat(const std::vector<Placement>& scenery,
                                      const Eigen::Vector2d& center, double radius_m) {
  return divided(scenery, center, std::numeric_limits<double>::infinity(), radius_m);
}

EmbreeReference EmbreeReference::divided(const std::vector<Placement>& scenery,
                                         const Eigen::Vector2d& center, double near_m,
                                         double radius_m) {
  EmbreeReference reference;
  TriangleSoup near;
  std::map<const Model*, RTCScene> plants;
  for (const Placement& placement : scenery) {
    const double distance = distance_m(placement, center);
    if (is_ground(*placement.model) || distance <= std::min(near_m, radius_m)) {
      near.add(*placement.model, placement.X_WM, placement.scale, center, radius_m);
    } else if (distance > near_m) {
      RTCScene& plant = plants[placement.model.get()];
      if (!plant) {
        TriangleSoup soup;
        soup.add(*placement.model, Pose{}, 1.0, center, radius_m);
        plant = rtcNewScene(reference.device_);
        reference.add_triangles(plant, soup);
        rtcCommitScene(plant);
      }
      reference.add_instance(plant, placement);
    }
  }
  reference.add_triangles(reference.scene_, near);
  for (const auto& [model, plant] : plants) rtcReleaseScene(plant);
  reference.commit();
  return reference;
}

void EmbreeReference::add_triangles(RTCScene scene, const TriangleSoup& soup) {
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                             RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                             soup.vertices.size()));
  auto* index = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), soup.triangles.size()));
  for (const Eigen::Vector3f& p : soup.vertices) vertex = std::copy_n(p.data(), 3, vertex);
  for (const auto& triangle : soup.triangles) index = std::copy_n(triangle.data(), 3, index);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  triangle_count_ += soup.triangles.size();
}

void EmbreeReference::add_instance(RTCScene plant, const Placement& placement) {
  RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(instance, plant);
  Eigen::Matrix<float, 3, 4> X = Eigen::Matrix<float, 3, 4>::Zero();  // column-major
  X.leftCols<3>() = (placement.scale * placement.X_WM.q.toRotationMatrix()).cast<float>();
  X.col(3) = placement.X_WM.p.cast<float>();
  rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, X.data());
  rtcCommitGeometry(instance);
  rtcAttachGeometry(scene_, instance);
  rtcReleaseGeometry(instance);
}

void EmbreeReference::commit() {
  rtcCommitScene(scene_);
  if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw Error("Embree: the scene was refused");
}

float EmbreeReference::cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                            float max_range_m) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit ray{};
  ray.ray.org_x = origin.x();
  ray.ray.org_y = origin.y();
  ray.ray.org_z = origin.z();
  ray.ray.dir_x = direction.x();
  ray.ray.dir_y = direction.y();
  ray.ray.dir_z = direction.z();
  ray.ray.tfar = max_range_m;
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_, &context, &ray);
  return ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<float>::infinity()
                                                   : ray.ray.tfar;
}

}  // namespace ardee::bench
