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

/// The ROS message of each kind of reading: a new alternative of Reading needs its overload here.
nav_msgs::Odometry to_message(const OdometryReading& reading);
tf2_msgs::TFMessage to_message(const TransformReading& reading);
sensor_msgs::JointState to_message(const JointStateReading& reading);
sensor_msgs::Imu to_message(const ImuReading& reading);
/// Without a fix nothing is known of the covariance.
sensor_msgs::NavSatFix to_message(const FixReading& reading);
geometry_msgs::Vector3Stamped to_message(const VectorReading& reading);
sensor_msgs::MagneticField to_message(const MagneticFieldReading& reading);
ardee_msgs::GpsQuality to_message(const GpsQualityReading& reading);
/// A box and a name for each region.
visualization_msgs::MarkerArray to_message(const RegionsReading& reading);
ardee_msgs::Encoder to_message(const EncoderReading& reading);
ardee_msgs::Battery to_message(const BatteryReading& reading);
sensor_msgs::BatteryState to_message(const BatteryStateReading& reading);
sensor_msgs::LaserScan to_message(const LidarReading& reading);
sensor_msgs::Range to_message(const RangeReading& reading);
sensor_msgs::PointCloud2 to_message(const PointCloudReading& reading);
sensor_msgs::PointCloud to_message(const LegacyCloudReading& reading);
sensor_msgs::Image to_message(const ImageReading& reading);
sensor_msgs::CameraInfo to_message(const CameraInfoReading& reading);
geometry_msgs::TwistStamped to_message(const TwistReading& reading);
control_msgs::JointControllerState to_message(const JointControllerReading& reading);
control_msgs::JointTrajectoryControllerState to_message(const TrajectoryControllerReading& reading);
four_wheel_steering_msgs::FourWheelSteeringStamped to_message(
    const FourWheelSteeringReading& reading);
gazebo_msgs::ContactsState to_message(const ContactsReading& reading);
geometry_msgs::WrenchStamped to_message(const WrenchReading& reading);

}  // namespace ardee::node
