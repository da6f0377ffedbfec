// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "ardee_sim/core/pose.h"
#include "ardee_sim/devices/reading_header.h"

namespace ardee::devices {

/// Pose of the child frame in header.frame_id, velocity in the child frame; covariances are the
/// diagonals of x, y, z, roll, pitch, yaw. The place in the world of an odometry frame is known
/// only from the readings in it.
struct OdometryReading {
  Header header;
  std::string child_frame_id;
  Pose pose;
  Twist twist;
  std::array<double, 6> pose_covariance{};
  std::array<double, 6> twist_covariance{};
  bool in_odometry_frame = true;  // false: in a frame of known place (ground truth)
};

/// The pose of the child frame in header.frame_id, an edge of the tree of frames.
struct TransformReading {
  Header header;
  std::string child_frame_id;
  Pose pose;
  bool in_odometry_frame = false;  // true: as in an OdometryReading
};

/// Positions in rad (m), velocities in rad/s (m/s), efforts in N m (N), joint by joint; no efforts
/// if they are unknown.
struct JointStateReading {
  Header header;
  std::vector<std::string> names;
  std::vector<double> positions;
  std::vector<double> velocities;
  std::vector<double> efforts;
};

/// Orientation of the sensor in the world's east-north-up frame, angular velocity in rad/s and
/// specific force in m/s^2 (+9.81 upwards at rest, REP 145) in the sensor's axes; covariances are
/// diagonals.
struct ImuReading {
  Header header;
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d angular_velocity{0, 0, 0};
  Eigen::Vector3d linear_acceleration{0, 0, 0};
  std::array<double, 3> orientation_covariance{};
  std::array<double, 3> angular_velocity_covariance{};
  std::array<double, 3> linear_acceleration_covariance{};
};

/// A position from satellites (sensor_msgs/NavSatFix): WGS-84 degrees, altitude in m; status and
/// service as that message numbers them; covariance is the diagonal of east, north, up in m^2.
struct FixReading {
  Header header;
  int status = 0;
  std::uint16_t service = 0;
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double altitude_m = 0.0;
  std::array<double, 3> covariance{};
};

/// A vector with time and frame (geometry_msgs/Vector3Stamped).
struct VectorReading {
  Header header;
  Eigen::Vector3d vector{0, 0, 0};
};

/// Tesla, in the sensor's axes.
struct MagneticFieldReading {
  Header header;
  Eigen::Vector3d field_T{0, 0, 0};
};

/// Present degradation of a satellite receiver: its region (empty: open sky), the standard
/// deviation of its position error in m, whether it has a fix, and its error in m (east, north,
/// up), which no real receiver knows.
struct GpsQualityReading {
  Header header;
  std::string region;
  double position_std_m = 0.0;
  bool has_fix = true;
  Eigen::Vector3d error_m{0, 0, 0};
};

/// Boxes to show in rviz, in header.frame_id.
struct RegionsReading {
  struct Region {
    std::string name;
    Pose pose;  // of the box's centre
    Eigen::Vector3d size_m{0, 0, 0};
    std::array<float, 4> rgba{};
  };
  Header header;
  std::vector<Region> regions;
};

}  // namespace ardee::devices
