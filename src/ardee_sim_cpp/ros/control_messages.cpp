// SPDX-License-Identifier: MIT
// The messages of ros_control's controllers.
#include "ros/conversions.h"
#include "ros/reading_to_message.h"

namespace ardee::node {
namespace {

trajectory_msgs::JointTrajectoryPoint to_ros(const devices::JointTrajectoryPoint& point) {
  trajectory_msgs::JointTrajectoryPoint message;
  message.positions = point.positions;
  message.velocities = point.velocities;
  message.accelerations = point.accelerations;
  message.effort = point.efforts;
  message.time_from_start = ros::Duration(point.time_from_start_s);
  return message;
}

}  // namespace

geometry_msgs::TwistStamped to_message(const devices::TwistReading& reading) {
  geometry_msgs::TwistStamped message;
  message.header = to_ros(reading.header);
  message.twist = to_ros(reading.twist);
  return message;
}

control_msgs::JointControllerState to_message(const devices::JointControllerReading& reading) {
  control_msgs::JointControllerState message;
  message.header = to_ros(reading.header);
  message.set_point = reading.set_point;
  message.process_value = reading.process_value;
  message.process_value_dot = reading.process_value_dot;
  message.error = reading.error;
  message.time_step = reading.time_step_s;
  message.command = reading.command;
  message.p = reading.p;
  message.i = reading.i;
  message.d = reading.d;
  message.i_clamp = reading.i_clamp;
  message.antiwindup = reading.antiwindup;
  return message;
}

control_msgs::JointTrajectoryControllerState to_message(
    const devices::TrajectoryControllerReading& reading) {
  control_msgs::JointTrajectoryControllerState message;
  message.header = to_ros(reading.header);
  message.joint_names = reading.names;
  message.desired = to_ros(reading.desired);
  message.actual = to_ros(reading.actual);
  message.error = to_ros(reading.error);
  return message;
}

four_wheel_steering_msgs::FourWheelSteeringStamped to_message(
    const devices::FourWheelSteeringReading& reading) {
  four_wheel_steering_msgs::FourWheelSteeringStamped message;
  message.header = to_ros(reading.header);
  message.data.front_steering_angle = static_cast<float>(reading.front_angle_rad);
  message.data.rear_steering_angle = static_cast<float>(reading.rear_angle_rad);
  message.data.front_steering_angle_velocity = static_cast<float>(reading.front_rate_rad_per_s);
  message.data.rear_steering_angle_velocity = static_cast<float>(reading.rear_rate_rad_per_s);
  message.data.speed = static_cast<float>(reading.speed_m_per_s);
  message.data.acceleration = static_cast<float>(reading.acceleration_m_per_s2);
  message.data.jerk = static_cast<float>(reading.jerk_m_per_s3);
  return message;
}

}  // namespace ardee::node
