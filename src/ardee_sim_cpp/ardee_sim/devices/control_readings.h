// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "ardee_sim/core/pose.h"
#include "ardee_sim/devices/command.h"
#include "ardee_sim/devices/reading_header.h"

namespace ardee::devices {

/// A velocity with time and frame (geometry_msgs/TwistStamped).
struct TwistReading {
  Header header;
  Twist twist;
};

/// State of a controller of one joint (control_msgs/JointControllerState): rad or m, their rates;
/// the command in the joint's interface.
struct JointControllerReading {
  Header header;
  double set_point = 0.0;
  double process_value = 0.0;
  double process_value_dot = 0.0;
  double error = 0.0;
  double time_step_s = 0.0;
  double command = 0.0;
  double p = 0.0;
  double i = 0.0;
  double d = 0.0;
  double i_clamp = 0.0;
  bool antiwindup = false;
};

/// Desired and actual state of joints, and the difference
/// (control_msgs/JointTrajectoryControllerState).
struct TrajectoryControllerReading {
  Header header;
  std::vector<std::string> names;
  JointTrajectoryPoint desired;
  JointTrajectoryPoint actual;
  JointTrajectoryPoint error;
};

/// Motion of a four-wheel steered vehicle (four_wheel_steering_msgs/FourWheelSteeringStamped):
/// angles of the virtual wheels at the middle of the axles, speed along the vehicle.
struct FourWheelSteeringReading {
  Header header;
  double front_angle_rad = 0.0;
  double rear_angle_rad = 0.0;
  double front_rate_rad_per_s = 0.0;
  double rear_rate_rad_per_s = 0.0;
  double speed_m_per_s = 0.0;
  double acceleration_m_per_s2 = 0.0;
  double jerk_m_per_s3 = 0.0;
};

}  // namespace ardee::devices
