// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/description/model.h"

namespace ardee::control {

/// Quantity of a joint's commands, by ros_control's interfaces.
enum class JointInterface { kPosition, kVelocity, kEffort };

/// "hardware_interface::VelocityJointInterface", as in list_controllers.
std::string interface_name(JointInterface interface);

/// A joint as controllers see it: the state measured at the beginning of a step, and the command.
/// SI units: rad or m, their rates, N m or N. `limits` are those of the robot's description.
struct JointHandle {
  std::string name;
  JointInterface interface = JointInterface::kEffort;
  JointType type = JointType::kContinuous;
  JointAxis limits;
  double position = 0.0;  // continuous over turns for a turning joint
  double velocity = 0.0;
  double effort = 0.0;
  double command = 0.0;
  void serialize(StateArchive& state) { state(position, velocity, effort, command); }
};

/// The joints that transmissions name, in the order of their names.
using Hardware = std::map<std::string, JointHandle>;

}  // namespace ardee::control
