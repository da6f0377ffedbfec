// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/joint_error.h"

#include <algorithm>
#include <cmath>

namespace ardee::control {
namespace {

constexpr double kTurn = 2.0 * 3.14159265358979323846;

}  // namespace

double shortest_turn(double angle_rad) { return std::remainder(angle_rad, kTurn); }

double within_limits(const JointHandle& joint, double position) {
  if (!has_limits(joint.type)) return position;
  return std::min(std::max(position, joint.limits.lower), joint.limits.upper);
}

double position_error(const JointHandle& joint, double position) {
  const double error = position - joint.position;
  if (!turns(joint.type)) return error;
  const double shortest = shortest_turn(error);
  if (!has_limits(joint.type)) return shortest;
  const auto is_allowed = [&](double turn) {
    const double end = joint.position + turn;
    return end >= joint.limits.lower && end <= joint.limits.upper;
  };
  const double longer = shortest - std::copysign(kTurn, shortest);
  return !is_allowed(shortest) && is_allowed(longer) ? longer : shortest;
}

}  // namespace ardee::control
