// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/devices/lidar_beams.h"
#include "ardee_sim/devices/lidar_params.h"
#include "ardee_sim/devices/sensor.h"

namespace ardee::devices {

/// A lidar over a grid of angles that gives sensor_msgs/PointCloud, row by row, with one unnamed
/// channel of intensities. Each beam has a point; by REP 117 the coordinates of one without a range
/// are all +inf (nothing within the maximum) or all -inf (nearer than the minimum).
class BlockLidar : public Sensor {
 public:
  /// libgazebo_ros_block_laser.so; its <gaussianNoise> is added to each coordinate, and to the
  /// intensity.
  static std::unique_ptr<Device> make(const SensorDescription& sensor,
                                      const PluginDescription& plugin, std::size_t link,
                                      DeviceContext& context);
  BlockLidar(const std::string& name, const Mount& mount, const LidarParams& params,
             double coordinate_std, RaySceneProvider& scenes);

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;
  bool wanted() const override { return output_.demanded; }

 private:
  LidarParams params_;
  double coordinate_std_;
  RaySceneProvider& scenes_;
  LidarBeams beams_;
  std::shared_ptr<void> eye_;
  std::vector<BeamEcho> echoes_;
  Output& output_;
};

}  // namespace ardee::devices
