// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/devices/geodesy.h"
#include "ardee_sim/devices/sensor.h"
#include "ardee_sim/devices/sensor_model.h"

namespace ardee::devices {

/// Keys of libhector_gazebo_ros_gps.so. Ours: <noiseMode> and <projection> (flat, as hector's, or
/// tangent).
struct GpsParams {
  Sensor::Mount mount;
  LocalFrame frame_on_earth{{}, 0.0, LocalFrame::Projection::kFlat};
  SensorErrors position{};
  SensorErrors velocity{};
  int status = 0;   // sensor_msgs/NavSatStatus: 0 is a fix
  int service = 0;  // likewise, bits
  std::string fix_topic{};
  std::string velocity_topic{};
  std::string frame{};
};

/// Reads these keys; the caller reads its own further keys.
GpsParams read_gps_params(Parameters& parameters, DeviceContext& context);

/// <topic>/status: a fix or none, its augmentation and the systems, as hector_gazebo_plugins/GNSS
/// for dynamic_reconfigure. Valid as long as the two numbers stay at their addresses.
ParameterGroup gnss_tuning(const std::string& name, int& status, int& service);

}  // namespace ardee::devices
