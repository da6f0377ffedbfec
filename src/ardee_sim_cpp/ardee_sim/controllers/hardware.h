// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

#include "ardee_sim/description/model.h"

namespace ardee::control {

/// What commands of a joint are, as the interfaces of ros_control name it.
enum class JointInterface { kPosition, kVelocity, kEffort };

/// "hardware_interface::VelocityJointInterface", as list_controllers has it.
std::string interface_name(JointInterface interface);

/// A joint as controllers see it: what is measured at the beginning of a step, and what is
/// commanded. SI units: rad or m, their rates, N m or N. `limits` are those of the robot's
/// description.
struct JointHandle {
  std::string name;
  JointInterface interface = JointInterface::kEffort;
  JointType type = JointType::kContinuous;
  JointAxis limits;
  double position = 0.0;  // of a turning joint: unwrapped over turns
  double velocity = 0.0;
  double effort = 0.0;
  double command = 0.0;
};

/// The joints that transmissions name, in the order of their names.
using Hardware = std::map<std::string, JointHandle>;

}  // namespace ardee::control
