// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/wheel_odometry.h"

#include <cmath>

namespace ardee::devices {

OdometrySource read_odometry_source(Parameters& parameters) {
  const std::string source = parameters.text("odometrySource", "world");
  if (source == "world" || source == "1") return OdometrySource::kWorld;
  if (source == "encoder" || source == "0") return OdometrySource::kEncoder;
  throw parameters.error("odometrySource", "expected world or encoder");
}

void WheelOdometry::roll(double left_m, double right_m, double separation_m) {
  const double turn = (right_m - left_m) / separation_m;
  const double yaw = rpy_from_quaternion(pose_.q).z();
  const double heading = yaw + turn / 2.0;
  pose_.p += 0.5 * (left_m + right_m) * Eigen::Vector3d(std::cos(heading), std::sin(heading), 0.0);
  pose_.q = quaternion_from_rpy({0.0, 0.0, yaw + turn});
}

}  // namespace ardee::devices
