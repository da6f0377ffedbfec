// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/lidar_params.h"

#include <algorithm>

#include "ardee_sim/devices/names.h"

namespace ardee::devices {

LidarParams read_lidar_params(const SensorDescription& sensor, Parameters& plugin,
                              raycast::SceneKind scene, const char* default_topic,
                              DeviceContext& context) {
  LidarParams params;
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
  constexpr double kMost_hz = 1e6;
  const Element* given = plugin.block("updateRate");
  // An empty one is 0 to Gazebo: no limit.
  const bool is_empty = given != nullptr && given->text.empty();
  const double own_hz = plugin.number("updateRate", is_empty ? 0.0 : fallback_hz, 0.0, kMost_hz);
  if (own_hz <= 0.0 || sensor.update_rate_hz <= 0.0) {
    return std::max(own_hz, sensor.update_rate_hz);
  }
  return std::min(own_hz, sensor.update_rate_hz);
}

double read_gaussian_noise(Parameters& plugin) { return plugin.number("gaussianNoise", 0.0, 0.0); }

}  // namespace ardee::devices
