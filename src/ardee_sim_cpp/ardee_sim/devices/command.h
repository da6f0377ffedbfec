// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ardee_sim/core/pose.h"
#include "ardee_sim/physics/contact.h"

namespace ardee::devices {

/// A request to act now, without content.
struct Trigger {};

/// Command of a four-wheel steered vehicle: angles of the virtual wheels at the middle of the axles
/// (rad), speed along the vehicle (m/s).
struct SteeringCommand {
  double front_angle_rad = 0.0;
  double rear_angle_rad = 0.0;
  double speed_m_per_s = 0.0;
};

/// A point of a trajectory, joint by joint in the order of the trajectory's names; a list that is
/// not given is empty. Units: rad or m, and their derivatives; N m or N.
struct JointTrajectoryPoint {
  std::vector<double> positions;
  std::vector<double> velocities;
  std::vector<double> accelerations;
  std::vector<double> efforts;
  double time_from_start_s = 0.0;
};

/// Desired motion of joints over time (trajectory_msgs/JointTrajectory). No start: at once.
struct JointTrajectory {
  std::optional<double> start_s;  // simulated time
  std::vector<std::string> joints;
  std::vector<JointTrajectoryPoint> points;
};

/// Any command that a device takes on a topic.
using Command = std::variant<Trigger, Twist, double, bool, std::vector<double>, SteeringCommand,
                             JointTrajectory, physics::ForceTorque>;

}  // namespace ardee::devices
