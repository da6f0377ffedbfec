// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "ardee_sim/devices/device.h"

namespace ardee::devices {

/// libroboticsgroup_gazebo_mimic_joint_plugin.so: a joint that follows another. The plugin sets the
/// follower's position; here a load on either joint acts on both.
class MimicJoint : public Device {
 public:
  static std::unique_ptr<Device> make(const PluginDescription& plugin, Parameters& parameters,
                                      DeviceContext& context);
  MimicJoint(const std::string& name, const Coupling& coupling, Robot& robot);

  void reset(TimeNs now_ns) override;

 private:
  Coupling coupling_;
  Robot& robot_;
};

}  // namespace ardee::devices
