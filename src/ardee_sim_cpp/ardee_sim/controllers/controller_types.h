// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "ardee_sim/controllers/controller.h"

namespace ardee::control {

/// Makes a controller or throws Error.
using MakeController = std::unique_ptr<Controller>(const ControllerContext&);
using ControllerMaker = std::function<MakeController>;
using ControllerTypes = std::map<std::string, ControllerMaker>;

/// The maker of a class, with what tells its types apart.
template <typename T, auto... kArguments>
std::unique_ptr<Controller> make(const ControllerContext& context) {
  return std::make_unique<T>(context, kArguments...);
}

// Each is defined in the file of its name, with its class.
MakeController make_ackermann_steering, make_diff_drive, make_force_torque_sensor,
    make_four_wheel_steering, make_imu_sensor, make_joint_state, make_mecanum_drive;

/// All built-in controllers, one line each, by the type names of ros_controllers.
const ControllerTypes& controller_types();

}  // namespace ardee::control
