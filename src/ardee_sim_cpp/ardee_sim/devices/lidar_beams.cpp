// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/lidar_beams.h"

#include <cmath>

namespace ardee {
namespace {

constexpr std::size_t kMostSubRays = std::size_t(1) << 22;

std::vector<Eigen::Vector3f> make_axes(const RayBlock& block) {
  std::vector<Eigen::Vector3f> axes_S;
  axes_S.reserve(block.rays());
  for (int row = 0; row < block.rows; ++row) {
    const double level = std::cos(block.elevation_rad(row));
    const double height = std::sin(block.elevation_rad(row));
    for (int column = 0; column < block.columns; ++column) {
      const double azimuth_rad = block.azimuth_rad(column);
      axes_S.emplace_back(static_cast<float>(level * std::cos(azimuth_rad)),
                          static_cast<float>(level * std::sin(azimuth_rad)),
                          static_cast<float>(height));
    }
  }
  return axes_S;
}

}  // namespace

/// The pose of each column, or one for all of them.
struct LidarBeams::Poses {
  const Pose* first;
  int columns;  // 1: the same for all
  int sub_rays;

  const Pose& of(std::size_t sub_ray) const {
    if (columns == 1) return *first;
    const std::size_t beam = sub_ray / static_cast<std::size_t>(sub_rays);
    return first[beam % static_cast<std::size_t>(columns)];
  }
};

LidarBeams::LidarBeams(const RayBlock& block, const LidarOptics& optics, bool look_through_near,
                       const Carrier& carrier)
    : columns_(block.columns),
      range_min_m_(block.range_min_m),
      range_max_m_(block.range_max_m),
      optics_(optics),
      look_through_near_(look_through_near),
      carrier_(carrier) {
  const std::size_t rays = block.rays() * static_cast<std::size_t>(optics.sub_rays);
  if (rays > kMostSubRays) {
    throw Error("found " + std::to_string(rays) + " rays with all sub-rays, expected up to " +
                std::to_string(kMostSubRays));
  }
  axes_S_ = make_axes(block);
  pattern_ = spread_beams(axes_S_, optics);
}

SceneRay LidarBeams::ray(const Pose& X_WS, std::size_t sub_ray, double from_m) const {
  const Eigen::Vector3d direction_S = pattern_.directions_S[sub_ray].cast<double>();
  const double reach_m = static_cast<double>(static_cast<float>(range_max_m_)) - from_m;
  return {X_WS * (from_m * direction_S), (X_WS.q * direction_S).normalized(), reach_m};
}

template <typename Cast>
void LidarBeams::look_beyond_minimum(const Poses& X_WS, const Cast& cast,
                                     std::vector<RayHit>& hits) const {
  const auto minimum_m = static_cast<float>(range_min_m_);
  std::vector<std::size_t> blocked;
  std::vector<SceneRay> rays;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!(hits[i].range_m < minimum_m)) continue;
    if (!look_through_near_ && hits[i].entity != carrier_.entity) continue;
    blocked.push_back(i);
    rays.push_back(ray(X_WS.of(i), i, range_min_m_));
  }
  if (blocked.empty()) return;
  std::vector<RayHit> beyond;
  cast(rays, beyond);
  for (std::size_t k = 0; k < blocked.size(); ++k) {
    beyond[k].range_m += minimum_m;
    hits[blocked[k]] = beyond[k];
  }
}

void LidarBeams::measure(const Pose& X_WS, const RayScene& scene,
                         std::vector<BeamEcho>& echoes) const {
  scene.cast(X_WS, pattern_, static_cast<float>(range_max_m_), carrier_.entity, carrier_.link,
             hits_);
  const Poses pose{&X_WS, 1, optics_.sub_rays};
  look_beyond_minimum(
      pose,
      [&](const std::vector<SceneRay>& rays, std::vector<RayHit>& hits) {
        scene.cast(rays, carrier_.entity, carrier_.link, hits);
      },
      hits_);
  make_echoes(pose, echoes);
}

void LidarBeams::measure_moving(const std::vector<Pose>& X_WS, const RayScene& scene,
                                std::vector<BeamEcho>& echoes) const {
  const Poses poses{X_WS.data(), columns_, optics_.sub_rays};
  const Poses pose_now{&X_WS.back(), 1, optics_.sub_rays};
  const std::size_t count = pattern_.directions_S.size();
  std::vector<SceneRay> rays;
  rays.reserve(count);
  const auto cast_at_others = [&](const std::vector<SceneRay>& some, std::vector<RayHit>& hits) {
    scene.cast(some, carrier_.entity, kAllLinks, hits);
  };
  for (std::size_t i = 0; i < count; ++i) rays.push_back(ray(poses.of(i), i, 0.0));
  cast_at_others(rays, hits_);
  look_beyond_minimum(poses, cast_at_others, hits_);

  const auto cast_at_own = [&](const std::vector<SceneRay>& some, std::vector<RayHit>& hits) {
    scene.cast_at_model(some, carrier_.entity, carrier_.link, hits);
  };
  for (std::size_t i = 0; i < count; ++i) rays[i] = ray(pose_now.of(i), i, 0.0);
  std::vector<RayHit> own;
  cast_at_own(rays, own);
  look_beyond_minimum(pose_now, cast_at_own, own);
  for (std::size_t i = 0; i < count; ++i) {
    if (!(own[i].range_m < hits_[i].range_m)) continue;
    hits_[i] = own[i];
    // The normal of now, as a sensor that was then where it is now would have seen it.
    const Pose& then = poses.of(i);
    hits_[i].normal_W =
        (then.q * (X_WS.back().q.conjugate() * own[i].normal_W.cast<double>())).cast<float>();
  }
  make_echoes(poses, echoes);
}

void LidarBeams::make_echoes(const Poses& X_WS, std::vector<BeamEcho>& echoes) const {
  EchoMaker maker(optics_, range_min_m_);
  const auto sub_rays = static_cast<std::size_t>(optics_.sub_rays);
  std::vector<float> cosines(sub_rays);
  echoes.resize(axes_S_.size());
  for (std::size_t beam = 0; beam < axes_S_.size(); ++beam) {
    const std::size_t first = beam * sub_rays;
    const Eigen::Quaternionf q = X_WS.of(first).q.cast<float>();
    for (std::size_t k = 0; k < sub_rays; ++k) {
      const Eigen::Vector3f direction_W = q * pattern_.directions_S[first + k];
      cosines[k] = std::abs(hits_[first + k].normal_W.dot(direction_W));
    }
    echoes[beam] = maker.make(&hits_[first], cosines.data());
  }
}

}  // namespace ardee
