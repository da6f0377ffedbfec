// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "ardee_sim/devices/device.h"

namespace ardee::devices {

/// libgazebo_ros_joint_state_publisher.so: positions and velocities of the named joints on
/// joint_states; no effort, no frame, as in the stock plugin. Without a namespace of its own or of
/// the spawn it publishes below the model's name.
class JointStatePublisher : public Device {
 public:
  static std::unique_ptr<Device> make(const PluginDescription& plugin, Parameters& parameters,
                                      DeviceContext& context);
  JointStatePublisher(const std::string& name, const std::string& topic,
                      std::vector<std::size_t> joints, double rate_hz, Robot& robot);

  void after_step(TimeNs now_ns, ReadingSink& sink) override;
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override { state(timer_); }

 private:
  std::vector<std::size_t> joints_;
  Robot& robot_;
  RateTimer timer_;
  Output& output_;
};

}  // namespace ardee::devices
