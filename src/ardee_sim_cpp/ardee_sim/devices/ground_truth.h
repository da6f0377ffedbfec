// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "ardee_sim/devices/sensor.h"

namespace ardee::devices {

/// libgazebo_ros_p3d.so: true pose of a link, in the world or relative to another link of the robot
/// (<frameName>), turned by <rpyOffset> and shifted by <xyzOffset> in that frame. <gaussianNoise>
/// acts on the velocities. These are in the axes of <frameName>, as in the stock plugin;
/// <local_twist> turns them into the link's, as nav_msgs/Odometry says.
class GroundTruth : public Sensor {
 public:
  struct Params {
    Mount mount;
    std::optional<std::size_t> reference_link{};  // none: the world
    Pose offset{};
    double gaussian_noise = 0.0;
    bool local_twist = false;
    std::string topic{};
    std::string frame{};
    std::string child_frame{};
  };

  static std::unique_ptr<Device> make(const PluginDescription& plugin, Parameters& parameters,
                                      DeviceContext& context);
  GroundTruth(const std::string& name, const Params& params);

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;
  bool wanted() const override { return output_.demanded; }

 private:
  /// Pose of the link, and its velocity in the axes of the reference frame.
  void relative_state(Pose& pose, Twist& twist) const;

  Params params_;
  Output& output_;
};

}  // namespace ardee::devices
