// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/ray_sensor.h"

#include <algorithm>
#include <cmath>

#include "ardee_sim/core/limits.h"
#include "ardee_sim/devices/names.h"

namespace ardee::devices {
namespace {

/// Separate stream of a scan, so that a beam's detection says nothing of its range's error.
CounterRng receiver_noise(const CounterRng& scan) { return scan.frame(0); }

}  // namespace

RaySensor::RaySensor(const std::string& name, const Mount& mount, const Params& params,
                     RaySceneProvider& scenes, std::size_t kind)
    : Sensor(name, mount),
      params_(params),
      scenes_(scenes),
      beams_(params.rays, params.optics, params.look_through_near,
             {mount.robot.entity(), static_cast<std::uint32_t>(mount.link)}),
      eye_(scenes.register_eye(params.scene, [this] { return pose().p; })),
      output_(add_output(params.topic, kind, params.frame)) {}

const std::vector<BeamEcho>& RaySensor::measure(const CounterRng& noise) {
  beams_.measure(pose(), scenes_.now(params_.scene), receiver_noise(noise), echoes_);
  return corrupted(noise);
}

const std::vector<BeamEcho>& RaySensor::measure_moving(const std::vector<Pose>& X_WS,
                                                       const CounterRng& noise) {
  beams_.measure_moving(X_WS, scenes_.now(params_.scene), receiver_noise(noise), echoes_);
  return corrupted(noise);
}

const std::vector<BeamEcho>& RaySensor::corrupted(const CounterRng& noise) {
  const RayBlock& rays = params_.rays;
  if (rays.noise.is_none()) return echoes_;
  for (std::size_t beam = 0; beam < echoes_.size(); ++beam) {
    float& range = echoes_[beam].range_m;
    if (!std::isfinite(range)) continue;
    const double noisy = rays.noise.corrupt(static_cast<double>(range), noise.normal(beam));
    range = static_cast<float>(std::clamp(noisy, rays.range_min_m, rays.range_max_m));
  }
  return echoes_;
}

double RaySensor::scan_time_s() const {
  return mount().rate_hz > 0.0 ? 1.0 / mount().rate_hz : elapsed_s();
}

RaySensor::Params read_lidar_params(const SensorDescription& sensor, Parameters& plugin,
                                    raycast::SceneKind scene, const char* default_topic,
                                    DeviceContext& context) {
  RaySensor::Params params;
  params.rays = read_ray_block(sensor, context.log);
  params.rays.noise.growth = plugin.number("noiseGrowth", 0.0, 0.0, 1.0);
  params.optics = read_lidar_optics(plugin);
  params.scene = scene;
  const std::string space = plugin_namespace(plugin, context);
  params.topic = resolve_topic(plugin.text("topicName", default_topic), space);
  params.frame =
      resolve_frame(plugin.text("frameName", "/world"), space, context, WithoutPrefix::kNamespace);
  params.look_through_near = plugin.boolean("lookThroughNear", false);
  plugin.ignore({"alwaysOn"});
  return params;
}

raycast::SceneKind scene_of(const SensorDescription& sensor) {
  return sensor.type.rfind("gpu_", 0) == 0 ? raycast::SceneKind::kVisual
                                           : raycast::SceneKind::kCollision;
}

double read_rate_hz(const SensorDescription& sensor, Parameters& plugin, double fallback_hz) {
  const Element* given = plugin.block("updateRate");
  // Gazebo reads an empty value as 0: no limit.
  const bool is_empty = given != nullptr && given->text.empty();
  const double own_hz =
      plugin.number("updateRate", is_empty ? 0.0 : fallback_hz, 0.0, limits::kMostRate_hz);
  return slower_rate_hz(own_hz, sensor.update_rate_hz);
}

double read_gaussian_noise(Parameters& plugin) { return plugin.number("gaussianNoise", 0.0, 0.0); }

}  // namespace ardee::devices
