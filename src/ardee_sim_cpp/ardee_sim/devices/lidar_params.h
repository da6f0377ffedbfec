// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "ardee_sim/devices/device.h"
#include "ardee_sim/devices/lidar_optics.h"
#include "ardee_sim/devices/ray_block.h"

namespace ardee::devices {

/// What all lidars share: SDF's <ray> block and the plugin's keys.
struct LidarParams {
  RayBlock rays;
  LidarOptics optics;
  raycast::SceneKind scene = raycast::SceneKind::kVisual;
  bool look_through_near =
      false;  // Gazebo's way: what is nearer than the minimum is not seen at all
  /// Of a planar lidar, from beam to beam; none: that of a mirror that turns once a scan.
  std::optional<double> time_increment_s;
  std::string topic;
  std::string frame;
};

/// Reads and checks them; the caller reads what keys are left and calls plugin.finish().
LidarParams read_lidar_params(const SensorDescription& sensor, Parameters& plugin,
                              raycast::SceneKind scene, const char* default_topic,
                              DeviceContext& context);

/// What a sensor's rays meet where the plugin's name does not say it: a sensor of type gpu_ray
/// meets visual bodies, one of type ray collision bodies (thesis 4.3.3).
raycast::SceneKind scene_of(const SensorDescription& sensor);

/// The rate of a plugin with an <updateRate> of its own: the slower of it and the sensor's. A rate
/// of 0 is no limit.
double read_rate_hz(const SensorDescription& sensor, Parameters& plugin, double fallback_hz);

/// The plugin's <gaussianNoise>: a standard deviation.
double read_gaussian_noise(Parameters& plugin);

}  // namespace ardee::devices
