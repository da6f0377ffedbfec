// SPDX-License-Identifier: MIT
#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/Vector3.h>
#include <geometry_msgs/Wrench.h>
#include <ros/time.h>
#include <std_msgs/Header.h>
#include <trajectory_msgs/JointTrajectory.h>

#include "ardee_sim/core/pose.h"
#include "ardee_sim/core/time.h"
#include "ardee_sim/devices/command.h"
#include "ardee_sim/devices/reading_header.h"
#include "ardee_sim/physics/contact.h"

namespace ardee::node {

ros::Time to_ros(TimeNs time_ns);
std_msgs::Header to_ros(const devices::Header& header);
geometry_msgs::Point to_point(const Eigen::Vector3d& point);
geometry_msgs::Vector3 to_vector(const Eigen::Vector3d& vector);
geometry_msgs::Quaternion to_quaternion(const Eigen::Quaterniond& q);
geometry_msgs::Pose to_ros(const Pose& pose);
geometry_msgs::Transform to_transform(const Pose& pose);
geometry_msgs::Twist to_ros(const Twist& twist);
geometry_msgs::Wrench to_ros(const physics::ForceTorque& wrench);

Eigen::Vector3d from_ros(const geometry_msgs::Vector3& vector);
Eigen::Vector3d from_ros(const geometry_msgs::Point& point);
/// A quaternion of zeros (an unset field) is the identity, others are normalised. Throws Error if
/// anything is not finite.
Pose from_ros(const geometry_msgs::Pose& pose);
Twist from_ros(const geometry_msgs::Twist& twist);
/// A stamp of zero means no start.
devices::JointTrajectory from_ros(const trajectory_msgs::JointTrajectory& message);
physics::ForceTorque from_ros(const geometry_msgs::Wrench& wrench);
bool is_finite(const Twist& twist);

}  // namespace ardee::node
