// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/four_wheel_geometry.h"

#include <algorithm>
#include <cmath>

#include "ardee_sim/core/limits.h"

namespace ardee::control {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kStill_m_per_s = 0.001;  // a slower vehicle counts as standing
constexpr std::array<double, 2> kSides = {-1.0, 1.0};

}  // namespace

std::array<AxleCommand, 2> FourWheelGeometry::for_twist(double forward, double turn) const {
  AxleCommand front;
  AxleCommand rear;
  const double across = turn * wheel_base_m / 2.0;
  const bool moves = std::abs(forward) > kStill_m_per_s;
  for (std::size_t i = 0; i < kSides.size(); ++i) {
    const double along = forward + kSides[i] * turn * steering_track_m() / 2.0;
    if (moves) {
      front.speeds[i] = (std::copysign(std::hypot(along, across), forward) +
                         kSides[i] * turn * steering_offset_m) /
                        radius_m;
      rear.speeds[i] = front.speeds[i];
    }
    if (std::abs(2.0 * forward) > std::abs(turn * steering_track_m())) {
      front.angles[i] = std::atan(across / along);
    } else if (moves) {
      front.angles[i] = std::copysign(kPi / 2.0, turn);
    }
    rear.angles[i] = -front.angles[i];
  }
  return {front, rear};
}

AxleCommand FourWheelGeometry::axle_for_steering(double angle_rad, double turn_per_m,
                                                 double speed_m_per_s) const {
  constexpr double kPole_m = 0.001;   // a turn's centre nearer to a wheel's axis gives no angle
  constexpr double kParallel = 0.01;  // a smaller difference of the wheels' tangents: no turn
  AxleCommand axle;
  const double across = std::tan(angle_rad);  // per metre along
  const double turn_over_track = turn_per_m * steering_track_m() / 2.0;
  if (std::abs(1.0 - std::abs(turn_over_track)) * wheel_base_m > kPole_m) {
    for (std::size_t i = 0; i < kSides.size(); ++i) {
      axle.angles[i] = std::atan(across / (1.0 + kSides[i] * turn_over_track));
    }
  }
  if (std::abs(speed_m_per_s) <= kStill_m_per_s) return axle;
  const bool turns = std::abs(std::tan(axle.angles[0]) - std::tan(axle.angles[1])) > kParallel;
  for (std::size_t i = 0; i < kSides.size(); ++i) {
    const double way = std::hypot(1.0 + kSides[i] * turn_over_track, turns ? across : 0.0) +
                       kSides[i] * turn_per_m * steering_offset_m;
    axle.speeds[i] = limits::wheel_command(speed_m_per_s * way / radius_m);
  }
  return axle;
}

std::array<AxleCommand, 2> FourWheelGeometry::for_steering(
    const devices::SteeringCommand& command) const {
  const double front = std::clamp(command.front_angle_rad, -kPi / 2.0, kPi / 2.0);
  const double rear = std::clamp(command.rear_angle_rad, -kPi / 2.0, kPi / 2.0);
  const double turn_per_m = (std::tan(front) - std::tan(rear)) / wheel_base_m;
  return {axle_for_steering(front, turn_per_m, command.speed_m_per_s),
          axle_for_steering(rear, turn_per_m, command.speed_m_per_s)};
}

double FourWheelGeometry::virtual_angle(double left_rad, double right_rad) {
  constexpr double kStraight = 0.001;
  if (std::abs(left_rad) <= kStraight && std::abs(right_rad) <= kStraight) return 0.0;
  const double left = std::tan(left_rad);
  const double right = std::tan(right_rad);
  return left + right == 0.0 ? 0.0 : std::atan(2.0 * left * right / (left + right));
}

PlanarMotion FourWheelGeometry::velocity(const AxleState& front, const AxleState& rear) const {
  constexpr double kPivot =
      1e-6;  // a wheel that does not roll with its axle's motion gives no speed
  const double tan_difference = std::tan(front.angle_rad) - std::tan(rear.angle_rad);
  PlanarMotion mean;
  for (const AxleState* axle : {&front, &rear}) {
    // at unit speed along the virtual wheel: the vehicle's turn, and the rolling speeds of its
    // wheels
    const double turn = std::cos(axle->angle_rad) * tan_difference / wheel_base_m;
    double speed = 0.0;
    for (std::size_t i = 0; i < kSides.size(); ++i) {
      const double along = std::cos(axle->angle_rad) + kSides[i] * turn * steering_track_m() / 2.0;
      const double rolls =
          std::hypot(along, std::sin(axle->angle_rad)) + kSides[i] * turn * steering_offset_m;
      if (std::abs(rolls) > kPivot) speed += axle->rates_rad_per_s[i] * radius_m / rolls / 2.0;
    }
    mean.forward += speed * std::cos(axle->angle_rad) / 2.0;
    mean.left += speed * std::sin(axle->angle_rad) / 2.0;
    mean.turn += speed * turn / 2.0;
  }
  return mean;
}

}  // namespace ardee::control
