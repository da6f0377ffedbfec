// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "ardee_sim/controllers/planar_odometry.h"
#include "ardee_sim/core/pose.h"
#include "ardee_sim/devices/command.h"

namespace ardee::control {

/// Values of the two wheels of an axle, left and right: angles in rad, speeds in rad/s.
struct AxleCommand {
  std::array<double, 2> angles{};
  std::array<double, 2> speeds{};
};

/// Motion of an axle: the angle of the virtual wheel at its middle, the rates of its two wheels.
struct AxleState {
  double angle_rad = 0.0;
  std::array<double, 2> rates_rad_per_s{};
};

/// A vehicle with four driven and steered wheels, which roll without slip.
struct FourWheelGeometry {
  double track_m = 0.0;            // between the wheels of an axle
  double steering_offset_m = 0.0;  // of a wheel from its steering axis
  double radius_m = 0.0;
  double wheel_base_m = 0.0;

  /// Distance between the steering axes of an axle.
  double steering_track_m() const { return track_m - 2.0 * steering_offset_m; }

  /// Motion of the front and rear axles for a speed forward and a turn (m/s, rad/s), the rear
  /// steered against the front.
  std::array<AxleCommand, 2> for_twist(double forward, double turn) const;
  /// Motion of the front and rear axles for virtual angles and a speed along the vehicle.
  std::array<AxleCommand, 2> for_steering(const devices::SteeringCommand& command) const;
  /// The angle of the virtual wheel at the middle of an axle, from the angles of its wheels.
  static double virtual_angle(double left_rad, double right_rad);
  /// Velocity of the vehicle's middle.
  PlanarMotion velocity(const AxleState& front, const AxleState& rear) const;

 private:
  AxleCommand axle_for_steering(double angle_rad, double turn_per_m, double speed_m_per_s) const;
};

}  // namespace ardee::control
