// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "ardee_sim/devices/reading_header.h"

namespace ardee::devices {

/// One sweep of a planar lidar. Ranges by REP 117: +inf beyond the maximum, -inf nearer than the
/// minimum.
struct LidarReading {
  Header header;
  double angle_min_rad = 0.0;
  double angle_max_rad = 0.0;
  double angle_increment_rad = 0.0;
  double time_increment_s = 0.0;  // from beam to beam
  double scan_time_s = 0.0;       // from scan to scan
  double range_min_m = 0.0;
  double range_max_m = 0.0;
  std::vector<float> ranges_m;
  std::vector<float> intensities;
};

/// One distance in a cone (sensor_msgs/Range).
struct RangeReading {
  enum class Radiation : std::uint8_t { kUltrasound = 0, kInfrared = 1 };
  Header header;
  Radiation radiation = Radiation::kUltrasound;
  double field_of_view_rad = 0.0;
  double range_min_m = 0.0;
  double range_max_m = 0.0;
  double range_m = 0.0;
};

/// Points with named fields, packed as sensor_msgs/PointCloud2 has them (little-endian).
struct PointCloudReading {
  /// Numbered as sensor_msgs/PointField numbers them.
  enum class Type : std::uint8_t { kUint8 = 2, kUint16 = 4, kUint32 = 6, kFloat32 = 7 };
  struct Field {
    std::string name;
    std::uint32_t offset = 0;
    Type type = Type::kFloat32;
  };
  Header header;
  std::uint32_t height = 1;
  std::uint32_t width = 0;
  std::vector<Field> fields;
  std::uint32_t point_step = 0;
  std::vector<std::uint8_t> data;
  bool is_dense = true;
};

/// sensor_msgs/PointCloud with one channel.
struct LegacyCloudReading {
  Header header;
  std::vector<Eigen::Vector3f> points;
  std::string channel_name;
  std::vector<float> channel;
};

}  // namespace ardee::devices
