// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/lidar.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ardee {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::unique_ptr<Device> make(const SensorDescription& sensor, const PluginDescription& plugin,
                             std::size_t link, SceneKind scene, DeviceContext& context) {
  const LidarParams params = read_lidar_params(sensor, plugin, scene, context);
  const Sensor::Mount mount{context.robot, link, sensor.X_LS, sensor.update_rate_hz, context.seed};
  return std::make_unique<Lidar>(sensor.name, mount, params, context.scenes);
}

RayPattern make_pattern(const LidarParams& params) {
  RayPattern pattern;
  pattern.directions_S.reserve(static_cast<std::size_t>(params.samples));
  for (int beam = 0; beam < params.samples; ++beam) {
    const double angle = params.angle_min_rad + beam * params.angle_increment_rad();
    pattern.directions_S.emplace_back(static_cast<float>(std::cos(angle)),
                                      static_cast<float>(std::sin(angle)), 0.0f);
  }
  return pattern;
}

}  // namespace

std::unique_ptr<Device> Lidar::make_on_collisions(const SensorDescription& sensor,
                                                  const PluginDescription& plugin, std::size_t link,
                                                  DeviceContext& context) {
  return make(sensor, plugin, link, SceneKind::kCollision, context);
}

std::unique_ptr<Device> Lidar::make_on_visuals(const SensorDescription& sensor,
                                               const PluginDescription& plugin, std::size_t link,
                                               DeviceContext& context) {
  return make(sensor, plugin, link, SceneKind::kVisual, context);
}

Lidar::Lidar(const std::string& name, const Mount& mount, const LidarParams& params,
             RayScenes& scenes)
    : Sensor(name, mount),
      params_(params),
      scenes_(scenes),
      pattern_(make_pattern(params)),
      eye_(scenes.register_eye(params.scene, [this] { return pose().p; })),
      output_(add_output(params.topic, reading_kind<LidarReading>())) {}

LidarReading Lidar::measure(const Pose& X_WS, const RayScene& scene) const {
  LidarReading reading;
  reading.angle_min_rad = params_.angle_min_rad;
  reading.angle_max_rad = params_.angle_max_rad;
  reading.angle_increment_rad = params_.angle_increment_rad();
  reading.range_min_m = params_.range_min_m;
  reading.range_max_m = params_.range_max_m;
  scene.cast(X_WS, pattern_, static_cast<float>(params_.range_max_m), mount().robot.entity(),
             static_cast<std::uint32_t>(mount().link), hits_);
  reading.ranges_m.resize(hits_.size());
  reading.intensities.resize(hits_.size());
  for (std::size_t beam = 0; beam < hits_.size(); ++beam) {
    const Eigen::Vector3f& direction_S = pattern_.directions_S[beam];
    RayHit hit = hits_[beam];
    // Its own housing, often a link of its own, is nearer than the minimum and blocks no real
    // lidar.
    const bool own_body = hit.entity == mount().robot.entity();
    if (params_.look_through_near || own_body)
      hit = first_beyond_minimum(hit, X_WS, direction_S, scene);
    const bool near = static_cast<double>(hit.range_m) < params_.range_min_m;
    reading.ranges_m[beam] = near ? -kInfinity : hit.range_m;
    if (!std::isfinite(reading.ranges_m[beam])) continue;
    // Retro as the user gave it; else the cosine of incidence of a white diffuse surface.
    const Eigen::Vector3f direction_W = X_WS.q.cast<float>() * direction_S;
    reading.intensities[beam] =
        hit.laser_retro > 0.0f ? hit.laser_retro : std::abs(hit.normal_W.dot(direction_W));
  }
  return reading;
}

RayHit Lidar::first_beyond_minimum(const RayHit& hit, const Pose& X_WS,
                                   const Eigen::Vector3f& direction_S,
                                   const RayScene& scene) const {
  const float minimum = static_cast<float>(params_.range_min_m);
  if (!(hit.range_m < minimum)) return hit;
  const Eigen::Vector3d start_S = params_.range_min_m * direction_S.cast<double>();
  std::vector<RayHit> beyond;
  scene.cast(X_WS * Pose{start_S, Eigen::Quaterniond::Identity()}, RayPattern{{direction_S}},
             static_cast<float>(params_.range_max_m) - minimum, mount().robot.entity(),
             static_cast<std::uint32_t>(mount().link), beyond);
  beyond.front().range_m += minimum;
  return beyond.front();
}

void Lidar::corrupt(LidarReading& reading, const CounterRng& noise) const {
  const double step_m = params_.precision_m;
  if (params_.noise_std_m <= 0.0 && params_.noise_mean_m == 0.0 && step_m <= 0.0) return;
  for (std::size_t beam = 0; beam < reading.ranges_m.size(); ++beam) {
    float& range = reading.ranges_m[beam];
    if (!std::isfinite(range)) continue;
    double noisy = static_cast<double>(range) + params_.noise_mean_m +
                   params_.noise_std_m * noise.normal(beam);
    if (step_m > 0.0) noisy = step_m * std::round(noisy / step_m);
    range = static_cast<float>(std::clamp(noisy, params_.range_min_m, params_.range_max_m));
  }
}

void Lidar::sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) {
  LidarReading reading = measure(pose(), scenes_.now(params_.scene));
  reading.header = {now_ns, params_.frame};
  corrupt(reading, noise);
  sink.on_reading(output_, reading);
}

}  // namespace ardee
