// SPDX-License-Identifier: MIT
#include "ros/reading_to_message.h"

#include "ros/conversions.h"

namespace ardee::node {
namespace {

std_msgs::Header to_message(const Header& header) {
  std_msgs::Header message;
  message.stamp = to_ros(header.stamp_ns);
  message.frame_id = header.frame_id;
  return message;
}

template <typename Matrix>
void set_diagonal(const std::array<double, 6>& diagonal, Matrix& matrix) {
  for (std::size_t i = 0; i < diagonal.size(); ++i) matrix[i * (diagonal.size() + 1)] = diagonal[i];
}

}  // namespace

sensor_msgs::LaserScan to_message(const LidarReading& reading) {
  sensor_msgs::LaserScan message;
  message.header = to_message(reading.header);
  message.angle_min = static_cast<float>(reading.angle_min_rad);
  message.angle_max = static_cast<float>(reading.angle_max_rad);
  message.angle_increment = static_cast<float>(reading.angle_increment_rad);
  message.range_min = static_cast<float>(reading.range_min_m);
  message.range_max = static_cast<float>(reading.range_max_m);
  message.ranges = reading.ranges_m;
  message.intensities = reading.intensities;
  return message;
}

nav_msgs::Odometry to_message(const OdometryReading& reading) {
  nav_msgs::Odometry message;
  message.header = to_message(reading.header);
  message.child_frame_id = reading.child_frame_id;
  message.pose.pose = to_ros(reading.pose);
  message.twist.twist = to_ros(reading.twist);
  set_diagonal(reading.pose_covariance, message.pose.covariance);
  set_diagonal(reading.twist_covariance, message.twist.covariance);
  return message;
}

tf2_msgs::TFMessage to_message(const TransformReading& reading) {
  tf2_msgs::TFMessage message;
  message.transforms.resize(1);
  message.transforms[0].header = to_message(reading.header);
  message.transforms[0].child_frame_id = reading.child_frame_id;
  message.transforms[0].transform = to_transform(reading.pose);
  return message;
}

sensor_msgs::JointState to_message(const JointStateReading& reading) {
  sensor_msgs::JointState message;
  message.header = to_message(reading.header);
  message.name = reading.names;
  message.position = reading.positions;
  message.velocity = reading.velocities;
  return message;
}

}  // namespace ardee::node
