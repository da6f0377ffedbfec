// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "ardee_sim/devices/camera_lens.h"
#include "ardee_sim/devices/device.h"
#include "ardee_sim/render/image_formation.h"

namespace ardee::devices {

/// Outputs of a Gazebo camera.
enum class CameraKind { kColor, kDepth, kOpenni };

/// Variant of Gazebo's camera plugins.
struct CameraPlugin {
  CameraKind kind = CameraKind::kColor;
  bool several = false;    // uses all <camera> blocks of the sensor
  bool triggered = false;  // takes a picture for each message on the trigger's topic
};

/// The error and the limits of measured depths.
struct DepthParams {
  double noise_constant_m = 0.0;  // standard deviation: constant + linear * z + quadratic * z^2
  double noise_linear = 0.0;
  double noise_quadratic_per_m = 0.0;
  double nearest_m = 0.0;    // NaN for nearer depths
  double farthest_m = 0.0;   // NaN for farther depths
  bool millimetres = false;  // 16UC1 instead of 32FC1

  bool has_noise() const {
    return noise_constant_m > 0.0 || noise_linear > 0.0 || noise_quadratic_per_m > 0.0;
  }
};

/// The topics of one camera; an empty one does not exist.
struct CameraTopics {
  std::string image;
  std::string info;
  std::string depth;
  std::string depth_info;
  std::string points;
  std::string labels;
  std::string instances;
  std::string fov;  // subscribed: sets the field of view
};

/// One camera: SDF's <camera> block and the plugin's keys.
struct CameraParams {
  Pose X_SC;  // in the sensor's frame; axes as SDF's, not optical
  int width = 320;
  int height = 240;
  CameraLens lens;
  double fov_min_rad = 0.0;  // lower bound of the zoom
  double fov_max_rad = 0.0;
  double near_m = 0.1;
  double far_m = 100.0;
  double exposure_time_s = 0.0;        // of each row
  double readout_time_s = 0.0;         // from the first row to the last
  render::ImageFormation development;  // of the image
  std::string encoding;                // of the image, as in sensor_msgs
  render::PixelFormat cloud_format =
      render::PixelFormat::kRgb8;  // of the cloud's colours: <format>
  DepthParams depth;
  CameraTopics topics;
  std::string frame;  // the optical one

  /// Contents of camera_info without its header.
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
