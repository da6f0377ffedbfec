// SPDX-License-Identifier: MIT
#pragma once

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include "ardee_sim/devices/reading.h"

namespace ardee::node {

/// The ROS message of each kind of reading: a new alternative of Reading needs its overload here.
/// time_increment and scan_time of a scan are 0, as the stock plugins leave them.
sensor_msgs::LaserScan to_message(const LidarReading& reading);
nav_msgs::Odometry to_message(const OdometryReading& reading);
tf2_msgs::TFMessage to_message(const TransformReading& reading);
sensor_msgs::JointState to_message(const JointStateReading& reading);

}  // namespace ardee::node
