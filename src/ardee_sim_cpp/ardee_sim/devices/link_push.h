// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "ardee_sim/devices/device.h"

namespace ardee::devices {

/// libgazebo_ros_force.so: pushes a link at its centre of mass with the last wrench received on a
/// topic, in the world's axes, at each step until the next one.
class LinkPush : public Device {
 public:
  static std::unique_ptr<Device> make(const PluginDescription& plugin, Parameters& parameters,
                                      DeviceContext& context);
  LinkPush(const std::string& name, const std::string& topic, std::size_t link, Robot& robot);

  void before_step(TimeNs now_ns) override;
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override { state(wrench_); }

 private:
  Robot& robot_;
  std::size_t link_;
  physics::ForceTorque wrench_;
};

}  // namespace ardee::devices
