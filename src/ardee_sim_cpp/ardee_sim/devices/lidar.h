// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/devices/lidar_beams.h"
#include "ardee_sim/devices/lidar_params.h"
#include "ardee_sim/devices/sensor.h"

namespace ardee::devices {

/// Range noise on all finite echoes, which stay within the device's limits. Beam i uses counter i.
void corrupt_echoes(const RayBlock& rays, const CounterRng& noise, std::vector<BeamEcho>& echoes);

/// A planar lidar, on collision or visual bodies. Beam i leaves the sensor's origin at angle_min +
/// i * increment about z. All beams are taken at the stamp; the times of a scan are told as the
/// drivers of turning lidars tell them.
class Lidar : public Sensor {
 public:
  /// libgazebo_ros_laser.so
  static std::unique_ptr<Device> make_on_collisions(const SensorDescription& sensor,
                                                    const PluginDescription& plugin,
                                                    std::size_t link, DeviceContext& context);
  /// libgazebo_ros_gpu_laser.so
  static std::unique_ptr<Device> make_on_visuals(const SensorDescription& sensor,
                                                 const PluginDescription& plugin, std::size_t link,
                                                 DeviceContext& context);
  Lidar(const std::string& name, const Mount& mount, const LidarParams& params,
        RaySceneProvider& scenes);

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;
  bool wanted() const override { return output_.demanded; }

 private:
  LidarParams params_;
  RaySceneProvider& scenes_;
  LidarBeams beams_;
  std::shared_ptr<void> eye_;
  std::vector<BeamEcho> echoes_;
  Output& output_;
};

}  // namespace ardee::devices
