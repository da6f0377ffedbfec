// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/joint_drive.h"

namespace ardee::physics {
namespace {

constexpr int kMotorRow = 0;
constexpr int kFrictionRow = 1;
constexpr int kSpringRow = 2;
constexpr int kRows = 3;
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
