// SPDX-License-Identifier: MIT
// JointDrive: the limits of an axis: its stops, and those of effort and velocity.
#include <algorithm>
#include <cmath>

#include "ardee_sim/physics/joint_drive.h"

namespace ardee::physics {
namespace {

// A stop has a row if it is within this reach (rad or m) or this many steps away, so that no load
// can move a joint past it.
constexpr double kStopReach = 0.2;
constexpr double kStopSteps = 4.0;

}  // namespace

double JointDrive::clamp(double position) const {
  return std::min(std::max(position, properties_.lower), properties_.upper);
}

double JointDrive::clamp_effort(double effort, double velocity) const {
  const bool too_fast = std::abs(velocity) > properties_.max_velocity;
  if (too_fast && effort * velocity > 0.0) return 0.0;
  return std::clamp(effort, -properties_.max_effort, properties_.max_effort);
}

void JointDrive::set_stop(int parameter, double value) {
  if (rotational_) {
    dJointSetAMotorParam(stops_.get(), parameter, value);
  } else {
    dJointSetSliderParam(slider_, parameter, value);
  }
}

void JointDrive::set_stop_row(double low, double high, double position, double erp) {
  if (rotational_) {
    dJointSetAMotorAngle(stops_.get(), 0, gain_ * position);
  }
  set_stop(dParamLoStop, gain_ * low);
  set_stop(dParamHiStop, gain_ * high);
  set_stop(dParamStopERP, erp);
}

void JointDrive::prepare_stops(double position, double velocity, const StepSettings& step) {
  // A slider's row uses its own measured position, which may differ in the last bit.
  if (!rotational_) position = dJointGetSliderPosition(slider_);
  const double erp = properties_.stop_erp >= 0.0 ? properties_.stop_erp : step.erp;
  const double cfm = properties_.stop_cfm >= 0.0 ? properties_.stop_cfm : step.cfm;
  set_stop(dParamStopCFM, gain_ * gain_ * cfm);
  if (properties_.lower == properties_.upper) {
    set_stop_row(properties_.lower, properties_.upper, position, erp);
    return;
  }
  const double above = position - properties_.lower, below = properties_.upper - position;
  const bool is_upper = below < above;
  const double gap = is_upper ? below : above;
  if (gap > kStopReach + kStopSteps * step.step_s * std::abs(velocity)) {
    set_stop_row(-dInfinity, dInfinity, position, erp);
    return;
  }
  // A joint past its stop comes back by ERP. A joint before its stop may close the gap within the
  // step, but not pass it: the row allows the velocity gap / h, which the engine computes for a
  // stop exceeded by the gap and an ERP of -1.
  const double passed = std::abs(gap);
  const double stop = is_upper ? position - passed : position + passed;
  set_stop_row(is_upper ? -dInfinity : stop, is_upper ? stop : dInfinity, position,
               gap >= 0.0 ? -1.0 : erp);
}

}  // namespace ardee::physics
