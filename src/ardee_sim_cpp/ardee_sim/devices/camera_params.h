// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "ardee_sim/devices/camera_lens.h"
#include "ardee_sim/devices/device.h"
#include "ardee_sim/render/image_formation.h"

namespace ardee::devices {

/// What a camera of Gazebo's gives.
enum class CameraKind { kColor, kDepth, kOpenni };

/// Which of Gazebo's camera plugins is meant.
struct CameraPlugin {
  CameraKind kind = CameraKind::kColor;
  bool several = false;    // all <camera> blocks of the sensor
  bool triggered = false;  // a picture for each message on the trigger's topic
};

/// The error and the limits of measured depths.
struct DepthParams {
  double noise_constant_m = 0.0;  // standard deviation: constant + linear * z + quadratic * z^2
  double noise_linear = 0.0;
  double noise_quadratic_per_m = 0.0;
  double nearest_m = 0.0;    // nearer is not a number
  double farthest_m = 0.0;   // likewise
  bool millimetres = false;  // 16UC1 instead of 32FC1

  bool has_noise() const {
    return noise_constant_m > 0.0 || noise_linear > 0.0 || noise_quadratic_per_m > 0.0;
  }
};

/// The topics of one camera; an empty one is not there.
struct CameraTopics {
  std::string image;
  std::string info;
  std::string depth;
  std::string depth_info;
  std::string points;
  std::string labels;
  std::string instances;
  std::string fov;  // that it listens to
};

/// One camera: SDF's <camera> block and the plugin's keys.
struct CameraParams {
  Pose X_SC;  // in the sensor's frame; axes as SDF's, not optical
  int width = 320;
  int height = 240;
  CameraLens lens;
  double fov_min_rad = 0.0;  // what it may be zoomed to
  double fov_max_rad = 0.0;
  double near_m = 0.1;
  double far_m = 100.0;
  render::ImageFormation development;  // of the image
  std::string encoding;                // of the image, as sensor_msgs has it
  render::PixelFormat cloud_format =
      render::PixelFormat::kRgb8;  // in which the cloud has its colours: <format>
  DepthParams depth;
  CameraTopics topics;
  std::string frame;  // the optical one

  /// What camera_info says, but for its header.
  CameraInfoReading info() const;
};

/// A sensor's cameras: one, or several of a multicamera.
struct CamerasParams {
  std::vector<CameraParams> cameras;
  double rate_hz = 0.0;  // 0: at each step
  bool triggered = false;
  std::string trigger_topic;
};

/// Reads and checks all cameras of a sensor. Throws Error.
CamerasParams read_cameras(const SensorDescription& sensor, Parameters& parameters,
                           const CameraPlugin& which, DeviceContext& context);

}  // namespace ardee::devices
