// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "ardee_sim/core/pose.h"
#include "ardee_sim/core/time.h"

namespace ardee {

struct Header {
  TimeNs stamp_ns = 0;
  std::string frame_id;
};

/// One sweep of a planar lidar. Ranges by REP 117: +inf beyond the maximum, -inf nearer than the
/// minimum.
struct LidarReading {
  Header header;
  double angle_min_rad = 0.0;
  double angle_max_rad = 0.0;
  double angle_increment_rad = 0.0;
  double range_min_m = 0.0;
  double range_max_m = 0.0;
  std::vector<float> ranges_m;
  std::vector<float> intensities;
};

/// Pose of the child frame in header.frame_id, velocity in the child frame; covariances are the
/// diagonals of x, y, z, roll, pitch, yaw.
struct OdometryReading {
  Header header;
  std::string child_frame_id;
  Pose pose;
  Twist twist;
  std::array<double, 6> pose_covariance{};
  std::array<double, 6> twist_covariance{};
};

/// A transform for the tf tree.
struct TransformReading {
  Header header;
  std::string child_frame_id;
  Pose pose;
};

/// Positions in rad (m), velocities in rad/s (m/s), joint by joint.
struct JointStateReading {
  Header header;
  std::vector<std::string> names;
  std::vector<double> positions;
  std::vector<double> velocities;
};

using Reading = std::variant<LidarReading, OdometryReading, TransformReading, JointStateReading>;

}  // namespace ardee
