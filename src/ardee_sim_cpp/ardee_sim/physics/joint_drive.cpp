// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/joint_drive.h"

#include <algorithm>

namespace ardee::physics {
namespace {

constexpr int kMotorRow = 0;
constexpr int kFrictionRow = 1;
constexpr int kSpringRow = 2;
// A stop has a row when it is within this reach (rad or m) or this many steps away, so that no load
// carries a joint past it.
constexpr double kStopReach = 0.2;
constexpr double kStopSteps = 4.0;
constexpr double kLeastSpring = 1e-12;  // N m s/rad: what is weaker does nothing

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
                                  const Eigen::Vector3d& axis_W, const JointAxis& axis) {
  JointDrive drive;
  drive.stops_ = angular_motor(world, child, parent, rel, axis_W, 1);
  drive.rows_ = angular_motor(world, child, parent, rel, axis_W, 3);
  drive.read(axis);
  return drive;
}

JointDrive JointDrive::linear(dWorldID world, dBodyID child, dBodyID parent, dJointID slider,
                              const Eigen::Vector3d& axis_W, const JointAxis& axis) {
  JointDrive drive;
  drive.rotational_ = false;
  drive.slider_ = slider;
  drive.rows_.reset(dJointCreateLMotor(world, nullptr));
  dJointAttach(drive.rows_.get(), child, parent);
  dJointSetLMotorNumAxes(drive.rows_.get(), 3);
  for (int i = 0; i < 3; ++i) {
    dJointSetLMotorAxis(drive.rows_.get(), i, 2, axis_W.x(), axis_W.y(), axis_W.z());
  }
  drive.read(axis);
  return drive;
}

void JointDrive::read(const JointAxis& axis) {
  lower_ = axis.lower;
  upper_ = axis.upper;
  max_effort_ = axis.effort;
  friction_ = axis.friction;
  spring_ = {axis.spring_stiffness, axis.damping, axis.spring_reference};
}

void JointDrive::set_motor(double velocity, double max_effort) {
  // As in Gazebo, the description's limits of effort and velocity do not bound a drive's motor.
  motor_velocity_ = velocity;
  motor_effort_ = max_effort;
}

void JointDrive::set_limits(double lower, double upper) {
  lower_ = lower;
  upper_ = upper;
}

void JointDrive::set_stop_softness(double erp, double cfm) {
  stop_erp_ = erp;
  stop_cfm_ = cfm;
}

void JointDrive::set_stop(int parameter, double value) {
  if (rotational_) {
    dJointSetAMotorParam(stops_.get(), parameter, value);
  } else {
    dJointSetSliderParam(slider_, parameter, value);
  }
}

double JointDrive::clamp(double position) const {
  return std::min(std::max(position, lower_), upper_);
}

double JointDrive::clamp_effort(double effort) const {
  return std::clamp(effort, -max_effort_, max_effort_);
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
  set(dParamVel, velocity);
  set(dParamFMax, max_effort);
  set(dParamCFM, cfm);
}

void JointDrive::set_stop_row(double low, double high, double position, double erp) {
  if (rotational_) {
    dJointSetAMotorAngle(stops_.get(), 0, position);
  }
  set_stop(dParamLoStop, low);
  set_stop(dParamHiStop, high);
  set_stop(dParamStopERP, erp);
}

void JointDrive::prepare_stops(double position, double velocity, const StepSettings& step) {
  // A slider's row compares with its own measure of the position, which may differ in the last bit.
  if (!rotational_) position = dJointGetSliderPosition(slider_);
  const double erp = stop_erp_ >= 0.0 ? stop_erp_ : step.erp;
  set_stop(dParamStopCFM, stop_cfm_ >= 0.0 ? stop_cfm_ : step.cfm);
  if (lower_ == upper_) {
    set_stop_row(lower_, upper_, position, erp);
    return;
  }
  const double above = position - lower_, below = upper_ - position;
  const bool is_upper = below < above;
  const double gap = is_upper ? below : above;
  if (gap > kStopReach + kStopSteps * step.step_s * std::abs(velocity)) {
    set_stop_row(-dInfinity, dInfinity, position, erp);
    return;
  }
  // A joint past its stop comes back by ERP. One short of it may take the gap within the step and
  // no more: the row allows the velocity gap / h, which the engine gives for a stop passed by the
  // gap and an ERP of -1.
  const double passed = std::abs(gap);
  const double stop = is_upper ? position - passed : position + passed;
  set_stop_row(is_upper ? -dInfinity : stop, is_upper ? stop : dInfinity, position,
               gap >= 0.0 ? -1.0 : erp);
}

void JointDrive::prepare_spring(double position, double step_s) {
  // Implicit Euler: with ERP = h k / (h k + c) and CFM = 1 / (h k + c) a row's effort is
  // -k (x + h v - x0) - c v at the velocity v after the step (ODE manual, 3.8.2).
  const double total = step_s * spring_.stiffness + spring_.damping;
  if (total < kLeastSpring) {
    set_row(kSpringRow, 0.0, 0.0, 0.0);
    return;
  }
  const double error = position - spring_.reference;
  set_row(kSpringRow, -spring_.stiffness * error / total, dInfinity, 1.0 / total);
}

void JointDrive::prepare(double position, double velocity, const StepSettings& step) {
  prepare_stops(position, velocity, step);
  set_row(kMotorRow, motor_velocity_, motor_effort_, step.cfm);
  set_row(kFrictionRow, 0.0, friction_, step.cfm);
  prepare_spring(position, step.step_s);
}

}  // namespace ardee::physics
