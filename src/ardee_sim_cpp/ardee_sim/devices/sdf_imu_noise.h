// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/devices/sensor_model.h"

namespace ardee::devices {

/// The errors of SDF's <imu> block, in rad/s and m/s^2.
struct SdfImuNoise {
  /// Errors of one vector.
  struct Axes {
    SensorErrors errors{};
    Eigen::Vector3d precision{0, 0, 0};  // values are multiples of it; 0: not quantised

    Eigen::Vector3d quantised(const Eigen::Vector3d& value) const;
  };
  Axes rate;
  Axes accel;
};

/// Reads <angular_velocity> and <linear_acceleration> with a <noise> per axis, or SDF 1.4's <noise>
/// with <rate> and <accel>. Means add to the value; a bias is drawn once, N(bias_mean, bias_stddev)
/// of either sign, as in Gazebo; <dynamic_bias_stddev> (of the driving noise, per root Hz) and
/// <dynamic_bias_correlation_time> make a drift.
SdfImuNoise read_sdf_imu_noise(const Element& imu, std::uint64_t key);

}  // namespace ardee::devices
