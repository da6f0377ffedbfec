// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "ardee_sim/controllers/controller.h"

namespace ardee::control {

/// imu_sensor_controller/ImuSensorController and
/// force_torque_sensor_controller/ForceTorqueSensorController read interfaces that the simulated
/// hardware lacks, here as in Gazebo: an Error, which says what to use instead.
std::unique_ptr<Controller> make_imu_sensor_controller(const ControllerContext& context);
std::unique_ptr<Controller> make_force_torque_sensor_controller(const ControllerContext& context);

}  // namespace ardee::control
