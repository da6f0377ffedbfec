// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>

#include "ros/conversions.h"
#include "ros/reading_to_message.h"

namespace ardee::node {

sensor_msgs::LaserScan to_message(const devices::LidarReading& reading) {
  sensor_msgs::LaserScan message;
  message.header = to_ros(reading.header);
  message.angle_min = static_cast<float>(reading.angle_min_rad);
  message.angle_max = static_cast<float>(reading.angle_max_rad);
  message.angle_increment = static_cast<float>(reading.angle_increment_rad);
  message.time_increment = static_cast<float>(reading.time_increment_s);
  message.scan_time = static_cast<float>(reading.scan_time_s);
  message.range_min = static_cast<float>(reading.range_min_m);
  message.range_max = static_cast<float>(reading.range_max_m);
  message.ranges = reading.ranges_m;
  message.intensities = reading.intensities;
  return message;
}

ardee_msgs::Encoder to_message(const devices::EncoderReading& reading) {
  ardee_msgs::Encoder message;
  message.header = to_ros(reading.header);
  message.id = reading.id;
  message.position = reading.position_rad;
  message.speed = reading.speed_m_per_s;
  message.qpps = reading.pulses_per_s;
  return message;
}

ardee_msgs::Battery to_message(const devices::BatteryReading& reading) {
  ardee_msgs::Battery message;
  message.header = to_ros(reading.header);
  message.voltage = reading.voltage_V;
  message.vmax = reading.voltage_max_V;
  message.vmin = reading.voltage_min_V;
  return message;
}

sensor_msgs::BatteryState to_message(const devices::BatteryStateReading& reading) {
  using Message = sensor_msgs::BatteryState;
  Message message;
  message.header = to_ros(reading.header);
  message.voltage = static_cast<float>(reading.voltage_V);
  message.temperature = std::numeric_limits<float>::quiet_NaN();  // not measured
  message.current = static_cast<float>(reading.current_A);
  message.charge = static_cast<float>(reading.charge_Ah);
  message.capacity = static_cast<float>(reading.capacity_Ah);
  message.design_capacity = static_cast<float>(reading.design_capacity_Ah);
  message.percentage = static_cast<float>(reading.percentage);
  message.power_supply_status = reading.current_A > 0.0 ? Message::POWER_SUPPLY_STATUS_CHARGING
                                                        : Message::POWER_SUPPLY_STATUS_DISCHARGING;
  message.power_supply_health = Message::POWER_SUPPLY_HEALTH_GOOD;
  message.power_supply_technology = Message::POWER_SUPPLY_TECHNOLOGY_LIPO;
  message.present = true;
  message.location = reading.location;
  return message;
}

sensor_msgs::Range to_message(const devices::RangeReading& reading) {
  sensor_msgs::Range message;
  message.header = to_ros(reading.header);
  message.radiation_type = static_cast<std::uint8_t>(reading.radiation);
  message.field_of_view = static_cast<float>(reading.field_of_view_rad);
  message.min_range = static_cast<float>(reading.range_min_m);
  message.max_range = static_cast<float>(reading.range_max_m);
  message.range = static_cast<float>(reading.range_m);
  return message;
}

sensor_msgs::PointCloud2 to_message(const devices::PointCloudReading& reading) {
  sensor_msgs::PointCloud2 message;
  message.header = to_ros(reading.header);
  message.height = reading.height;
  message.width = reading.width;
  for (const devices::PointCloudReading::Field& field : reading.fields) {
    sensor_msgs::PointField& kept = message.fields.emplace_back();
    kept.name = field.name;
    kept.offset = field.offset;
    kept.datatype = static_cast<std::uint8_t>(field.type);
    kept.count = 1;
  }
  message.is_bigendian = false;
  message.point_step = reading.point_step;
  message.row_step = reading.point_step * reading.width;
  message.data = reading.data;
  message.is_dense = reading.is_dense;
  return message;
}

sensor_msgs::PointCloud to_message(const devices::LegacyCloudReading& reading) {
  sensor_msgs::PointCloud message;
  message.header = to_ros(reading.header);
  for (const Eigen::Vector3f& point : reading.points) {
    geometry_msgs::Point32& kept = message.points.emplace_back();
    kept.x = point.x();
    kept.y = point.y();
    kept.z = point.z();
  }
  message.channels.resize(1);
  message.channels[0].name = reading.channel_name;
  message.channels[0].values = reading.channel;
  return message;
}

sensor_msgs::Image to_message(const devices::ImageReading& reading) {
  sensor_msgs::Image message;
  message.header = to_ros(reading.header);
  message.height = reading.height;
  message.width = reading.width;
  message.encoding = reading.encoding;
  message.is_bigendian = false;
  message.step = reading.step;
  message.data = reading.data;
  return message;
}

sensor_msgs::CameraInfo to_message(const devices::CameraInfoReading& reading) {
  sensor_msgs::CameraInfo message;
  message.header = to_ros(reading.header);
  message.height = reading.height;
  message.width = reading.width;
  message.distortion_model = "plumb_bob";
  message.D.assign(reading.D.begin(), reading.D.end());
  std::copy(reading.K.begin(), reading.K.end(), message.K.begin());
  std::copy(reading.R.begin(), reading.R.end(), message.R.begin());
  std::copy(reading.P.begin(), reading.P.end(), message.P.begin());
  return message;
}

}  // namespace ardee::node
