// SPDX-License-Identifier: MIT
#include "ros/reading_to_message.h"

#include "ros/conversions.h"

namespace ardee::node {
namespace {

template <std::size_t kSize, typename Matrix>
void set_diagonal(const std::array<double, kSize>& diagonal, Matrix& matrix) {
  for (std::size_t i = 0; i < kSize; ++i) matrix[i * (kSize + 1)] = diagonal[i];
}

visualization_msgs::Marker box_marker(const devices::RegionsReading::Region& region) {
  visualization_msgs::Marker marker;
  marker.ns = "regions";
  marker.type = visualization_msgs::Marker::CUBE;
  marker.pose = to_ros(region.pose);
  marker.scale = to_vector(region.size_m);
  marker.color.r = region.rgba[0];
  marker.color.g = region.rgba[1];
  marker.color.b = region.rgba[2];
  marker.color.a = region.rgba[3];
  return marker;
}

visualization_msgs::Marker name_marker(const devices::RegionsReading::Region& region) {
  constexpr double kTextHeight_m = 0.3;
  visualization_msgs::Marker marker;
  marker.ns = "names";
  marker.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
  marker.text = region.name;
  marker.pose.position =
      to_point(region.pose.p + Eigen::Vector3d(0, 0, region.size_m.z() / 2.0 + kTextHeight_m));
  marker.pose.orientation.w = 1.0;
  marker.scale.z = kTextHeight_m;
  marker.color.r = marker.color.g = marker.color.b = marker.color.a = 1.0f;
  return marker;
}

}  // namespace

nav_msgs::Odometry to_message(const devices::OdometryReading& reading) {
  nav_msgs::Odometry message;
  message.header = to_ros(reading.header);
  message.child_frame_id = reading.child_frame_id;
  message.pose.pose = to_ros(reading.pose);
  message.twist.twist = to_ros(reading.twist);
  set_diagonal(reading.pose_covariance, message.pose.covariance);
  set_diagonal(reading.twist_covariance, message.twist.covariance);
  return message;
}

tf2_msgs::TFMessage to_message(const devices::TransformReading& reading) {
  tf2_msgs::TFMessage message;
  message.transforms.resize(1);
  message.transforms[0].header = to_ros(reading.header);
  message.transforms[0].child_frame_id = reading.child_frame_id;
  message.transforms[0].transform = to_transform(reading.pose);
  return message;
}

sensor_msgs::JointState to_message(const devices::JointStateReading& reading) {
  sensor_msgs::JointState message;
  message.header = to_ros(reading.header);
  message.name = reading.names;
  message.position = reading.positions;
  message.velocity = reading.velocities;
  message.effort = reading.efforts;
  return message;
}

sensor_msgs::Imu to_message(const devices::ImuReading& reading) {
  sensor_msgs::Imu message;
  message.header = to_ros(reading.header);
  message.orientation = to_quaternion(reading.orientation);
  message.angular_velocity = to_vector(reading.angular_velocity);
  message.linear_acceleration = to_vector(reading.linear_acceleration);
  set_diagonal(reading.orientation_covariance, message.orientation_covariance);
  set_diagonal(reading.angular_velocity_covariance, message.angular_velocity_covariance);
  set_diagonal(reading.linear_acceleration_covariance, message.linear_acceleration_covariance);
  return message;
}

sensor_msgs::NavSatFix to_message(const devices::FixReading& reading) {
  sensor_msgs::NavSatFix message;
  message.header = to_ros(reading.header);
  message.status.status = static_cast<std::int8_t>(reading.status);
  message.status.service = reading.service;
  message.latitude = reading.latitude_deg;
  message.longitude = reading.longitude_deg;
  message.altitude = reading.altitude_m;
  if (message.status.status == sensor_msgs::NavSatStatus::STATUS_NO_FIX) {
    message.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_UNKNOWN;
  } else {
    set_diagonal(reading.covariance, message.position_covariance);
    message.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_DIAGONAL_KNOWN;
  }
  return message;
}

geometry_msgs::Vector3Stamped to_message(const devices::VectorReading& reading) {
  geometry_msgs::Vector3Stamped message;
  message.header = to_ros(reading.header);
  message.vector = to_vector(reading.vector);
  return message;
}

sensor_msgs::MagneticField to_message(const devices::MagneticFieldReading& reading) {
  sensor_msgs::MagneticField message;
  message.header = to_ros(reading.header);
  message.magnetic_field = to_vector(reading.field_T);
  return message;
}

ardee_msgs::GpsQuality to_message(const devices::GpsQualityReading& reading) {
  ardee_msgs::GpsQuality message;
  message.header = to_ros(reading.header);
  message.region = reading.region;
  message.position_std = reading.position_std_m;
  message.has_fix = reading.has_fix;
  message.error = to_vector(reading.error_m);
  return message;
}

visualization_msgs::MarkerArray to_message(const devices::RegionsReading& reading) {
  visualization_msgs::MarkerArray message;
  int id = 0;
  for (const devices::RegionsReading::Region& region : reading.regions) {
    for (visualization_msgs::Marker marker : {box_marker(region), name_marker(region)}) {
      marker.header = to_ros(reading.header);
      marker.id = id;
      message.markers.push_back(marker);
    }
    ++id;
  }
  return message;
}

}  // namespace ardee::node
