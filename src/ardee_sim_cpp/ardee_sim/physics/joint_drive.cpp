// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/joint_drive.h"

#include <algorithm>
#include <cmath>

namespace ardee::physics {
namespace {

constexpr int kMotorRow = 0;
constexpr int kFrictionRow = 1;
constexpr int kSpringRow = 2;
constexpr int kRows = 3;
// A stop has a row if it is within this reach (rad or m) or this many steps away, so that no load
// can move a joint past it.
constexpr double kStopReach = 0.2;
constexpr double kStopSteps = 4.0;
constexpr double kLeastSpring = 1e-12;  // N m s/rad: a weaker spring has no effect

JointHandle angular_motor(dWorldID world, dBodyID child, dBodyID parent, int rel,
                          const Eigen::Vector3d& axis_W, int rows) {
  JointHandle joint(dJointCreateAMotor(world, nullptr));
  dJointAttach(joint.get(), child, parent);
  dJointSetAMotorMode(joint.get(), dAMotorUser);
  dJointSetAMotorNumAxes(joint.get(), rows);
  for (int i = 0; i < rows; ++i) {
    dJointSetAMotorAxis(joint.get(), i, rel, axis_W.x(), axis_W.y(), axis_W.z());
  }
  return joint;
}

}  // namespace

JointDrive JointDrive::rotational(dWorldID world, dBodyID child, dBodyID parent, int rel,
                                  const Eigen::Vector3d& axis_W,
                                  const JointProperties& properties) {
  JointDrive drive;
  drive.rel_ = rel;
  drive.stops_ = angular_motor(world, child, parent, rel, axis_W, 1);
  drive.rows_ = angular_motor(world, child, parent, rel, axis_W, kRows);
  drive.properties_ = properties;
  return drive;
}

JointDrive JointDrive::linear(dWorldID world, dBodyID child, dBodyID parent, dJointID slider,
                              const Eigen::Vector3d& axis_W, const JointProperties& properties) {
  JointDrive drive;
  drive.rotational_ = false;
  drive.slider_ = slider;
  drive.rows_.reset(dJointCreateLMotor(world, nullptr));
  dJointAttach(drive.rows_.get(), child, parent);
  dJointSetLMotorNumAxes(drive.rows_.get(), kRows);
  for (int i = 0; i < kRows; ++i) {
    dJointSetLMotorAxis(drive.rows_.get(), i, 2, axis_W.x(), axis_W.y(), axis_W.z());
  }
  drive.properties_ = properties;
  return drive;
}

void JointDrive::set_stop(int parameter, double value) {
  if (rotational_) {
    dJointSetAMotorParam(stops_.get(), parameter, value);
  } else {
    dJointSetSliderParam(slider_, parameter, value);
  }
}

double JointDrive::clamp(double position) const {
  return std::min(std::max(position, properties_.lower), properties_.upper);
}

double JointDrive::clamp_effort(double effort, double velocity) const {
  const bool too_fast = std::abs(velocity) > properties_.max_velocity;
  if (too_fast && effort * velocity > 0.0) return 0.0;
  return std::clamp(effort, -properties_.max_effort, properties_.max_effort);
}

void JointDrive::aim(const Eigen::Vector3d& direction_W, double gain) {
  gain_ = gain;
  const Eigen::Vector3d& d = direction_W;
  dJointSetAMotorAxis(stops_.get(), 0, rel_, d.x(), d.y(), d.z());
  for (int i = 0; i < kRows; ++i) {
    dJointSetAMotorAxis(rows_.get(), i, rel_, d.x(), d.y(), d.z());
  }
}

std::vector<dJointID> JointDrive::joints() const {
  std::vector<dJointID> made{rows_.get()};
  if (stops_) made.push_back(stops_.get());
  return made;
}

void JointDrive::set_row(int row, double velocity, double max_effort, double cfm) {
  const int group = dParamGroup * row;
  const auto set = [&](int parameter, double value) {
    if (rotational_) {
      dJointSetAMotorParam(rows_.get(), parameter + group, value);
    } else {
      dJointSetLMotorParam(rows_.get(), parameter + group, value);
    }
  };
  // Along a direction of length g a velocity is g times, and an effort 1 / g times, that of the
  // axis.
  set(dParamVel, gain_ * velocity);
  set(dParamFMax, max_effort / gain_);
  set(dParamCFM, gain_ * gain_ * cfm);
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

void JointDrive::prepare_spring(double position, double step_s) {
  // Implicit Euler: with ERP = h k / (h k + c) and CFM = 1 / (h k + c) a row's effort is
  // -k (x + h v - x0) - c v at the velocity v after the step (ODE manual, 3.8.2).
  const JointSpring& spring = properties_.spring;
  const double total = step_s * spring.stiffness + spring.damping;
  if (total < kLeastSpring) {
    set_row(kSpringRow, 0.0, 0.0, 0.0);
    return;
  }
  const double error = position - spring.reference;
  set_row(kSpringRow, -spring.stiffness * error / total, dInfinity, 1.0 / total);
}

void JointDrive::prepare(double position, double velocity, const StepSettings& step) {
  prepare_stops(position, velocity, step);
  const double motor_cfm = properties_.motor_cfm >= 0.0 ? properties_.motor_cfm : step.cfm;
  set_row(kMotorRow, motor_.velocity, motor_.max_effort, motor_cfm);
  set_row(kFrictionRow, 0.0, properties_.friction, step.cfm);
  prepare_spring(position, step.step_s);
}

}  // namespace ardee::physics
