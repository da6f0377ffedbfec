// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/device.h"
#include "ardee_sim/devices/names.h"

namespace ardee::devices {

/// Publisher of a drive's wheels, on the plugin's request: the states of their joints, and their
/// links' transforms.
class WheelPublisher {
 public:
  struct Wheel {
    std::size_t joint = 0;
    std::string parent_frame;  // of the joint's links
    std::string frame;
  };
  struct Params {
    std::vector<Wheel> wheels;  // in the order in which they are published
    bool has_states = false;
    bool has_transforms = false;
    std::string topic;  // of the states
  };

  /// `rate_hz` is that at which the drive calls publish().
  WheelPublisher(const Params& params, double rate_hz, Ports& ports, Robot& robot);

  void publish(TimeNs now_ns, ReadingSink& sink) const;

 private:
  Params params_;
  Robot& robot_;
  Output* output_ = nullptr;
  Output* tf_output_ = nullptr;
};

/// <publishWheelTF> and <publishWheelJointState>, of the wheels on `joints`.
WheelPublisher::Params read_wheel_publisher_params(
    Parameters& parameters, const std::vector<std::size_t>& joints,
    const std::string& robot_namespace, const DeviceContext& context,
    WithoutPrefix without_prefix = WithoutPrefix::kNothing);

}  // namespace ardee::devices
