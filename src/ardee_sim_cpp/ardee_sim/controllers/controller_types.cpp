// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/controller_types.h"

#include "ardee_sim/controllers/ackermann_steering_controller.h"
#include "ardee_sim/controllers/diff_drive_controller.h"
#include "ardee_sim/controllers/forward_controller.h"
#include "ardee_sim/controllers/four_wheel_steering_controller.h"
#include "ardee_sim/controllers/gripper_controller.h"
#include "ardee_sim/controllers/joint_state_controller.h"
#include "ardee_sim/controllers/mecanum_drive_controller.h"
#include "ardee_sim/controllers/pid_controller.h"
#include "ardee_sim/controllers/sensor_controllers.h"
#include "ardee_sim/controllers/trajectory_controller.h"

namespace ardee::control {

const ControllerTypes& controller_types() {
  static const ControllerTypes types{
      {"ackermann_steering_controller/AckermannSteeringController",
       AckermannSteeringController::make},
      {"diff_drive_controller/DiffDriveController", DiffDriveController::make},
      {"effort_controllers/GripperActionController", GripperController::make_effort},
      {"effort_controllers/JointEffortController", ForwardController::make_effort},
      {"effort_controllers/JointGroupEffortController", ForwardController::make_group_effort},
      {"effort_controllers/JointGroupPositionController",
       PidController::make_effort_group_position},
      {"effort_controllers/JointPositionController", PidController::make_effort_position},
      {"effort_controllers/JointVelocityController", PidController::make_effort_velocity},
      {"effort_controllers/JointTrajectoryController", TrajectoryController::make_effort},
      {"force_torque_sensor_controller/ForceTorqueSensorController",
       ForceTorqueSensorController::make},
      {"four_wheel_steering_controller/FourWheelSteeringController",
       FourWheelSteeringController::make},
      {"imu_sensor_controller/ImuSensorController", ImuSensorController::make},
      {"joint_state_controller/JointStateController", JointStateController::make},
      {"mecanum_drive_controller/MecanumDriveController", MecanumDriveController::make},
      {"pos_vel_acc_controllers/JointTrajectoryController", TrajectoryController::make_pos_vel_acc},
      {"pos_vel_controllers/JointTrajectoryController", TrajectoryController::make_pos_vel},
      {"position_controllers/GripperActionController", GripperController::make_position},
      {"position_controllers/JointGroupPositionController", ForwardController::make_group_position},
      {"position_controllers/JointPositionController", ForwardController::make_position},
      {"position_controllers/JointTrajectoryController", TrajectoryController::make_position},
      {"velocity_controllers/JointGroupVelocityController", ForwardController::make_group_velocity},
      {"velocity_controllers/JointPositionController", PidController::make_velocity_position},
      {"velocity_controllers/JointTrajectoryController", TrajectoryController::make_velocity},
      {"velocity_controllers/JointVelocityController", ForwardController::make_velocity}};
  return types;
}

}  // namespace ardee::control
