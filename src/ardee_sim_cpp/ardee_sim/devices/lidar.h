// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "ardee_sim/devices/lidar_params.h"
#include "ardee_sim/devices/sensor.h"

namespace ardee {

/// A planar lidar, on collision or visual bodies. Beam i leaves the sensor's origin at angle_min +
/// i * increment about z.
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
  Lidar(const std::string& name, const Mount& mount, const LidarParams& params, RayScenes& scenes);

  /// The ideal scan from X_WS: a pure function of the scene.
  LidarReading measure(const Pose& X_WS, const RayScene& scene) const;
  /// Gaussian range noise; noisy ranges stay within the device's limits. Beam i uses counter i.
  void corrupt(LidarReading& reading, const CounterRng& noise) const;

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;
  bool wanted() const override { return output_.demanded; }

 private:
  RayHit first_beyond_minimum(const RayHit& hit, const Pose& X_WS,
                              const Eigen::Vector3f& direction_S, const RayScene& scene) const;

  LidarParams params_;
  RayScenes& scenes_;
  RayPattern pattern_;
  std::shared_ptr<void> eye_;
  mutable std::vector<RayHit> hits_;  // scratch, to spare an allocation a scan
  Output& output_;
};

}  // namespace ardee
