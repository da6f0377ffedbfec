// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "ardee_sim/devices/ray_sensor.h"

namespace ardee::devices {

/// A lidar over a grid of angles that gives sensor_msgs/PointCloud, row by row, with one unnamed
/// channel of intensities. Each beam has a point; by REP 117 the coordinates of a point without a
/// range are all +inf (nothing within the maximum) or all -inf (nearer than the minimum).
class BlockLidar : public RaySensor {
 public:
  /// libgazebo_ros_block_laser.so; its <gaussianNoise> is added to each coordinate, and to the
  /// intensity.
  static std::unique_ptr<Device> make(const SensorDescription& sensor, Parameters& keys,
                                      std::size_t link, DeviceContext& context);
  BlockLidar(const std::string& name, const Mount& mount, const Params& params,
             double coordinate_std, RaySceneProvider& scenes);

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;

 private:
  double coordinate_std_;
};

}  // namespace ardee::devices
