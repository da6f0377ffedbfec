// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/sensor_controllers.h"

#include "ardee_sim/core/error.h"

namespace ardee::control {
namespace {

Error lacking(const ControllerContext& context, const std::string& interface,
              const std::string& instead) {
  return Error(context.settings.path() + "/type: found a controller that needs the " + interface +
               ", which the simulated hardware lacks, as gazebo_ros_control's DefaultRobotHWSim "
               "does, expected " +
               instead);
}

}  // namespace

std::unique_ptr<Controller> make_imu_sensor_controller(const ControllerContext& context) {
  throw lacking(context, "hardware_interface::ImuSensorInterface",
                "an imu sensor with the plugin libgazebo_ros_imu_sensor.so instead");
}

std::unique_ptr<Controller> make_force_torque_sensor_controller(const ControllerContext& context) {
  throw lacking(context, "hardware_interface::ForceTorqueSensorInterface",
                "the efforts in joint_states of a joint_state_controller instead");
}

}  // namespace ardee::control
