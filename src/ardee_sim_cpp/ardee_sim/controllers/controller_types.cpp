// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/controller_types.h"

#include "ardee_sim/controllers/forward_controller.h"
#include "ardee_sim/controllers/gripper_controller.h"
#include "ardee_sim/controllers/pid_controller.h"
#include "ardee_sim/controllers/trajectory_controller.h"

namespace ardee::control {

const ControllerTypes& controller_types() {
  using Quantity = PidController::Quantity;
  constexpr JointInterface kPosition = JointInterface::kPosition;
  constexpr JointInterface kVelocity = JointInterface::kVelocity;
  constexpr JointInterface kEffort = JointInterface::kEffort;
  constexpr JointCount kOne = JointCount::kOne;
  constexpr JointCount kGroup = JointCount::kGroup;
  static const ControllerTypes types{
      {"ackermann_steering_controller/AckermannSteeringController", make_ackermann_steering},
      {"diff_drive_controller/DiffDriveController", make_diff_drive},
      {"effort_controllers/GripperActionController", make<GripperController, kEffort>},
      {"effort_controllers/JointEffortController", make<ForwardController, kEffort, kOne>},
      {"effort_controllers/JointGroupEffortController", make<ForwardController, kEffort, kGroup>},
      {"effort_controllers/JointGroupPositionController",
       make<PidController, kEffort, Quantity::kPosition, kGroup>},
      {"effort_controllers/JointPositionController",
       make<PidController, kEffort, Quantity::kPosition, kOne>},
      {"effort_controllers/JointVelocityController",
       make<PidController, kEffort, Quantity::kVelocity, kOne>},
      {"effort_controllers/JointTrajectoryController", make<TrajectoryController, kEffort>},
      {"force_torque_sensor_controller/ForceTorqueSensorController", make_force_torque_sensor},
      {"four_wheel_steering_controller/FourWheelSteeringController", make_four_wheel_steering},
      {"imu_sensor_controller/ImuSensorController", make_imu_sensor},
      {"joint_state_controller/JointStateController", make_joint_state},
      {"mecanum_drive_controller/MecanumDriveController", make_mecanum_drive},
      {"pos_vel_acc_controllers/JointTrajectoryController", TrajectoryController::make_pos_vel_acc},
      {"pos_vel_controllers/JointTrajectoryController", TrajectoryController::make_pos_vel},
      {"position_controllers/GripperActionController", make<GripperController, kPosition>},
      {"position_controllers/JointGroupPositionController",
       make<ForwardController, kPosition, kGroup>},
      {"position_controllers/JointPositionController", make<ForwardController, kPosition, kOne>},
      {"position_controllers/JointTrajectoryController", make<TrajectoryController, kPosition>},
      {"velocity_controllers/JointGroupVelocityController",
       make<ForwardController, kVelocity, kGroup>},
      {"velocity_controllers/JointPositionController",
       make<PidController, kVelocity, Quantity::kPosition, kOne>},
      {"velocity_controllers/JointTrajectoryController", make<TrajectoryController, kVelocity>},
      {"velocity_controllers/JointVelocityController", make<ForwardController, kVelocity, kOne>}};
  return types;
}

}  // namespace ardee::control
