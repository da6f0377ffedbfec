// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "ardee_sim/devices/ray_sensor.h"

namespace ardee::devices {

/// A planar lidar. Beam i leaves the sensor's origin at angle_min + i * increment about z. All
/// beams are measured at the stamp; the times of a scan are reported as by the drivers of rotating
/// lidars.
class Lidar : public RaySensor {
 public:
  /// libgazebo_ros_laser.so on collision bodies, libgazebo_ros_gpu_laser.so on visual ones.
  static std::unique_ptr<Device> make(const SensorDescription& sensor, Parameters& keys,
                                      std::size_t link, raycast::SceneKind scene,
                                      DeviceContext& context);
  /// `time_increment_s` is the time between beams; none: that of a mirror that turns once per scan.
  Lidar(const std::string& name, const Mount& mount, const Params& params,
        std::optional<double> time_increment_s, RaySceneProvider& scenes);

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;

 private:
  std::optional<double> time_increment_s_;
};

}  // namespace ardee::devices
