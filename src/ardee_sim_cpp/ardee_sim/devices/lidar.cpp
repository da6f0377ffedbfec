// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/lidar.h"

#include <algorithm>
#include <cmath>

namespace ardee::devices {
namespace {

constexpr double kMostTimeIncrement_s = 1e3;

std::unique_ptr<Device> make(const SensorDescription& sensor, const PluginDescription& plugin,
                             std::size_t link, raycast::SceneKind scene, DeviceContext& context) {
  Parameters keys(plugin.element);
  LidarParams params = read_lidar_params(sensor, keys, scene, "/world", context);
  if (keys.has("timeIncrement")) {
    params.time_increment_s = keys.number("timeIncrement", 0.0, 0.0, kMostTimeIncrement_s);
  }
  keys.ignore({"updateRate", "gaussianNoise", "hokuyoMinIntensity"});
  keys.finish(context.log);
  if (params.rays.rows > 1) {
    context.log.warn(
        sensor.element.source.to_string() +
        ": found several rows, expected one: a LaserScan holds one, the horizontal one is used");
    params.rays.rows = 1;
  }
  const Sensor::Mount mount{context.robot, link, sensor.X_LS, sensor.update_rate_hz, context.seed};
  return std::make_unique<Lidar>(sensor.name, mount, params, context.scenes);
}

}  // namespace

void corrupt_echoes(const RayBlock& rays, const CounterRng& noise, std::vector<BeamEcho>& echoes) {
  if (rays.noise.is_none()) return;
  for (std::size_t beam = 0; beam < echoes.size(); ++beam) {
    float& range = echoes[beam].range_m;
    if (!std::isfinite(range)) continue;
    const double noisy = rays.noise.corrupt(static_cast<double>(range), noise.normal(beam));
    range = static_cast<float>(std::clamp(noisy, rays.range_min_m, rays.range_max_m));
  }
}

std::unique_ptr<Device> Lidar::make_on_collisions(const SensorDescription& sensor,
                                                  const PluginDescription& plugin, std::size_t link,
                                                  DeviceContext& context) {
  return make(sensor, plugin, link, raycast::SceneKind::kCollision, context);
}

std::unique_ptr<Device> Lidar::make_on_visuals(const SensorDescription& sensor,
                                               const PluginDescription& plugin, std::size_t link,
                                               DeviceContext& context) {
  return make(sensor, plugin, link, raycast::SceneKind::kVisual, context);
}

Lidar::Lidar(const std::string& name, const Mount& mount, const LidarParams& params,
             RaySceneProvider& scenes)
    : Sensor(name, mount),
      params_(params),
      scenes_(scenes),
      beams_(params.rays, params.optics, params.look_through_near,
             {mount.robot.entity(), static_cast<std::uint32_t>(mount.link)}),
      eye_(scenes.register_eye(params.scene, [this] { return pose().p; })),
      output_(add_output(params.topic, reading_kind<LidarReading>())) {}

void Lidar::sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) {
  const RayBlock& rays = params_.rays;
  beams_.measure(pose(), scenes_.now(params_.scene), echoes_);
  corrupt_echoes(rays, noise, echoes_);
  LidarReading reading;
  reading.header = {now_ns, params_.frame};
  reading.angle_min_rad = rays.angle_min_rad;
  reading.angle_max_rad = rays.angle_max_rad;
  reading.angle_increment_rad = rays.angle_increment_rad();
  reading.scan_time_s = mount().rate_hz > 0.0 ? 1.0 / mount().rate_hz : elapsed_s();
  reading.time_increment_s = params_.time_increment_s.value_or(
      std::abs(reading.angle_increment_rad) / (2.0 * M_PI) * reading.scan_time_s);
  reading.range_min_m = rays.range_min_m;
  reading.range_max_m = rays.range_max_m;
  reading.ranges_m.reserve(echoes_.size());
  reading.intensities.reserve(echoes_.size());
  for (const BeamEcho& echo : echoes_) {
    reading.ranges_m.push_back(echo.range_m);
    reading.intensities.push_back(echo.intensity);
  }
  sink.on_reading(output_, reading);
}

}  // namespace ardee::devices
