// SPDX-License-Identifier: MIT
#pragma once

#include <ardee_msgs/Battery.h>
#include <ardee_msgs/Encoder.h>
#include <ardee_msgs/GpsQuality.h>
#include <control_msgs/JointControllerState.h>
#include <control_msgs/JointTrajectoryControllerState.h>
#include <four_wheel_steering_msgs/FourWheelSteeringStamped.h>
#include <gazebo_msgs/ContactsState.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MagneticField.h>
#include <sensor_msgs/NavSatFix.h>
#include <sensor_msgs/PointCloud.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/Range.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include "ardee_sim/devices/reading.h"

namespace ardee::node {

/// The ROS message of each kind of reading: a new alternative of Reading needs an overload here.
nav_msgs::Odometry to_message(const devices::OdometryReading& reading);
tf2_msgs::TFMessage to_message(const devices::TransformReading& reading);
sensor_msgs::JointState to_message(const devices::JointStateReading& reading);
sensor_msgs::Imu to_message(const devices::ImuReading& reading);
/// Without a fix the covariance is marked as unknown.
sensor_msgs::NavSatFix to_message(const devices::FixReading& reading);
geometry_msgs::Vector3Stamped to_message(const devices::VectorReading& reading);
sensor_msgs::MagneticField to_message(const devices::MagneticFieldReading& reading);
ardee_msgs::GpsQuality to_message(const devices::GpsQualityReading& reading);
/// A box and a name for each region.
visualization_msgs::MarkerArray to_message(const devices::RegionsReading& reading);
ardee_msgs::Encoder to_message(const devices::EncoderReading& reading);
ardee_msgs::Battery to_message(const devices::BatteryReading& reading);
sensor_msgs::BatteryState to_message(const devices::BatteryStateReading& reading);
sensor_msgs::LaserScan to_message(const devices::LidarReading& reading);
sensor_msgs::Range to_message(const devices::RangeReading& reading);
sensor_msgs::PointCloud2 to_message(const devices::PointCloudReading& reading);
sensor_msgs::PointCloud to_message(const devices::LegacyCloudReading& reading);
sensor_msgs::Image to_message(const devices::ImageReading& reading);
sensor_msgs::CameraInfo to_message(const devices::CameraInfoReading& reading);
geometry_msgs::TwistStamped to_message(const devices::TwistReading& reading);
control_msgs::JointControllerState to_message(const devices::JointControllerReading& reading);
control_msgs::JointTrajectoryControllerState to_message(
    const devices::TrajectoryControllerReading& reading);
four_wheel_steering_msgs::FourWheelSteeringStamped to_message(
    const devices::FourWheelSteeringReading& reading);
gazebo_msgs::ContactsState to_message(const devices::ContactsReading& reading);
geometry_msgs::WrenchStamped to_message(const devices::WrenchReading& reading);

}  // namespace ardee::node
