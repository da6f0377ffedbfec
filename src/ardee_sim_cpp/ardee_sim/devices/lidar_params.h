// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/devices/device.h"

namespace ardee {

/// A planar lidar: SDF's <ray> block and the plugin's keys.
struct LidarParams {
  int samples = 640;           // beams, SDF's samples * resolution
  double angle_min_rad = 0.0;  // may exceed angle_max_rad: the scan then runs backwards
  double angle_max_rad = 0.0;
  double range_min_m = 0.0;
  double range_max_m = 10.0;
  double noise_mean_m = 0.0;
  double noise_std_m = 0.0;
  double precision_m = 0.0;  // noisy ranges are multiples of it; 0: not quantised
  SceneKind scene = SceneKind::kVisual;
  bool look_through_near =
      false;  // Gazebo's way: what is nearer than range_min_m is not seen at all
  std::string topic;
  std::string frame;

  /// Angle between beams; 0 for a single one.
  double angle_increment_rad() const {
    return samples > 1 ? (angle_max_rad - angle_min_rad) / (samples - 1) : 0.0;
  }
};

/// Reads and checks them; `scene` is what the plugin's name says: gazebo_ros_laser meets collision
/// bodies, gazebo_ros_gpu_laser visual ones (thesis 4.3.3).
LidarParams read_lidar_params(const SensorDescription& sensor, const PluginDescription& plugin,
                              SceneKind scene, DeviceContext& context);

}  // namespace ardee
