// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "ardee_sim/devices/device.h"

namespace ardee {
using namespace physics;
using namespace devices;

/// Readings as bytes: equal bytes mean values equal in each bit.
class ReadingBytes {
 public:
  void put(const Reading& reading) {
    std::visit([this](const auto& each) { add(each.header), add_reading(each); }, reading);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  template <typename T>
  std::enable_if_t<std::is_arithmetic_v<T> || std::is_enum_v<T>> add(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }
  template <typename Derived>
  void add(const Eigen::MatrixBase<Derived>& matrix) {
    for (const auto value : matrix.eval().reshaped()) add(value);
  }
  template <typename T, std::size_t kSize>
  void add(const std::array<T, kSize>& values) {
    for (const T& value : values) add(value);
  }
  template <typename T>
  void add(const std::vector<T>& values) {
    add(values.size());
    for (const T& value : values) add(value);
  }
  void add(const std::string& text) {
    add(text.size());
    bytes_ += text;
  }
  void add(const Header& header) { all(header.stamp_ns, header.frame_id); }
  void add(const Pose& pose) { all(pose.p, pose.q.coeffs()); }
  void add(const Twist& twist) { all(twist.linear, twist.angular); }
  void add(const PointCloudReading::Field& field) { all(field.name, field.offset, field.type); }
  void add(const RegionsReading::Region& region) {
    all(region.name, region.pose, region.size_m, region.rgba);
  }
  void add(const JointTrajectoryPoint& point) {
    all(point.positions, point.velocities, point.accelerations, point.efforts,
        point.time_from_start_s);
  }
  void add(const ForceTorque& wrench) { all(wrench.force, wrench.torque); }
  void add(const Contact& contact) {
    all(contact.position, contact.normal, contact.depth_m, contact.on1, contact.on2);
  }
  void add(const ContactsReading::Touch& touch) {
    all(touch.time_ns, touch.collision1, touch.collision2, touch.points);
  }
  template <typename... Values>
  void all(const Values&... values) {
    (add(values), ...);
  }

  void add_reading(const LidarReading& r) {
    all(r.angle_min_rad, r.angle_max_rad, r.angle_increment_rad, r.range_min_m, r.range_max_m,
        r.ranges_m, r.intensities);
  }
  void add_reading(const OdometryReading& r) {
    all(r.child_frame_id, r.pose, r.twist, r.pose_covariance, r.twist_covariance,
        r.in_odometry_frame);
  }
  void add_reading(const TransformReading& r) { all(r.child_frame_id, r.pose); }
  void add_reading(const JointStateReading& r) {
    all(r.names, r.positions, r.velocities, r.efforts);
  }
  void add_reading(const ImuReading& r) {
    all(r.orientation.coeffs(), r.angular_velocity, r.linear_acceleration, r.orientation_covariance,
        r.angular_velocity_covariance, r.linear_acceleration_covariance);
  }
  void add_reading(const FixReading& r) {
    all(r.status, r.service, r.latitude_deg, r.longitude_deg, r.altitude_m, r.covariance);
  }
  void add_reading(const VectorReading& r) { add(r.vector); }
  void add_reading(const MagneticFieldReading& r) { add(r.field_T); }
  void add_reading(const EncoderReading& r) {
    all(r.id, r.position_rad, r.speed_m_per_s, r.pulses_per_s);
  }
  void add_reading(const BatteryReading& r) { all(r.voltage_V, r.voltage_max_V, r.voltage_min_V); }
  void add_reading(const BatteryStateReading& r) {
    all(r.voltage_V, r.current_A, r.charge_Ah, r.capacity_Ah, r.design_capacity_Ah, r.percentage,
        r.location);
  }
  void add_reading(const RangeReading& r) {
    all(r.radiation, r.field_of_view_rad, r.range_min_m, r.range_max_m, r.range_m);
  }
  void add_reading(const PointCloudReading& r) {
    all(r.height, r.width, r.fields, r.point_step, r.data, r.is_dense);
  }
  void add_reading(const LegacyCloudReading& r) { all(r.points, r.channel_name, r.channel); }
  void add_reading(const ImageReading& r) { all(r.height, r.width, r.encoding, r.step, r.data); }
  void add_reading(const CameraInfoReading& r) { all(r.height, r.width, r.D, r.K, r.R, r.P); }
  void add_reading(const GpsQualityReading& r) {
    all(r.region, r.position_std_m, r.has_fix, r.error_m);
  }
  void add_reading(const RegionsReading& r) { add(r.regions); }
  void add_reading(const TwistReading& r) { add(r.twist); }
  void add_reading(const JointControllerReading& r) {
    all(r.set_point, r.process_value, r.process_value_dot, r.error, r.time_step_s, r.command, r.p,
        r.i, r.d, r.i_clamp, r.antiwindup);
  }
  void add_reading(const TrajectoryControllerReading& r) {
    all(r.names, r.desired, r.actual, r.error);
  }
  void add_reading(const FourWheelSteeringReading& r) {
    all(r.front_angle_rad, r.rear_angle_rad, r.front_rate_rad_per_s, r.rear_rate_rad_per_s,
        r.speed_m_per_s, r.acceleration_m_per_s2, r.jerk_m_per_s3);
  }
  void add_reading(const ContactsReading& r) { add(r.touches); }
  void add_reading(const WrenchReading& r) { add(r.wrench); }

  std::string bytes_;
};

/// Bytes of all readings, topic by topic, in the order of arrival.
class BytesByTopic : public ReadingSink {
 public:
  void on_reading(const Output& output, const Reading& reading) override {
    topics_[output.topic].put(reading);
  }
  std::map<std::string, std::string> take() {
    std::map<std::string, std::string> bytes;
    for (const auto& [topic, readings] : topics_) bytes[topic] = readings.bytes();
    topics_.clear();
    return bytes;
  }

 private:
  std::map<std::string, ReadingBytes> topics_;
};

/// Returns the topics whose bytes differ, or that one of the two lacks.
inline std::vector<std::string> differing(const std::map<std::string, std::string>& one,
                                          const std::map<std::string, std::string>& other) {
  std::vector<std::string> topics;
  for (const auto& [topic, bytes] : one) {
    const auto found = other.find(topic);
    if (found == other.end() || found->second != bytes) topics.push_back(topic);
  }
  for (const auto& [topic, bytes] : other) {
    if (one.count(topic) == 0) topics.push_back(topic);
  }
  return topics;
}

}  // namespace ardee
