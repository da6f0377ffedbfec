// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/joint_actuator.h"

#include <algorithm>
#include <cmath>

#include "ardee_sim/controllers/joint_error.h"
#include "ardee_sim/core/limits.h"

namespace ardee::control {

JointActuator::JointActuator(JointHandle& handle, std::size_t joint, const CommandLimits& limits,
                             const std::optional<PidGains>& gains)
    : handle_(handle), joint_(joint), limiter_(limits) {
  if (gains) pid_.emplace(*gains);
}

void JointActuator::read(const physics::PhysicsModel& physics) {
  handle_.position = physics.joint_position(joint_);
  handle_.velocity = physics.joint_velocity(joint_);
}

void JointActuator::write(physics::PhysicsModel& physics, double dt_s, bool is_stopped) {
  if (!is_stopped) held_position_.reset();
  if (is_stopped && handle_.interface == JointInterface::kPosition) {
    if (!held_position_) held_position_ = handle_.position;
    handle_.command = *held_position_;
  }
  limiter_.enforce(handle_, dt_s);
  if (!is_motor()) return push(physics, wanted_effort(dt_s, is_stopped));
  const bool is_position = handle_.interface == JointInterface::kPosition;
  if (is_position) physics.set_joint_position(joint_, handle_.command);
  physics.set_joint_motor(joint_, is_position || is_stopped ? 0.0 : handle_.command,
                          limiter_.limits().max_effort);
}

double JointActuator::wanted_effort(double dt_s, bool is_stopped) {
  const double most = limiter_.limits().max_effort;
  switch (handle_.interface) {
    case JointInterface::kEffort:
      return is_stopped ? 0.0 : handle_.command;
    case JointInterface::kPosition:
      return std::clamp(pid_->update(position_error(handle_, handle_.command), dt_s), -most, most);
    case JointInterface::kVelocity:
      break;
  }
  const double velocity = is_stopped ? 0.0 : handle_.command;
  return std::clamp(pid_->update(velocity - handle_.velocity, dt_s), -most, most);
}

/// Stores the acting effort as the measured one: the effort within the joint's limits.
void JointActuator::push(physics::PhysicsModel& physics, double effort) {
  const physics::JointProperties& joint = physics.joint_properties(joint_, 0);
  const double velocity = physics.joint_velocity(joint_);
  const bool is_too_fast = std::abs(velocity) > joint.max_velocity && effort * velocity > 0.0;
  const double most = std::min(joint.max_effort, limits::kStrongest);
  handle_.effort = is_too_fast ? 0.0 : std::clamp(effort, -most, most);
  physics.apply_joint_effort(joint_, handle_.effort);
}

void JointActuator::reset(physics::PhysicsModel& physics) {
  handle_.command = 0.0;
  handle_.effort = 0.0;
  limiter_.reset();
  held_position_.reset();
  if (pid_) {
    pid_->reset();
    pid_->restore_gains();
  }
  if (is_motor()) {
    physics::JointProperties properties = physics.joint_properties(joint_, 0);
    properties.friction = 0.0;
    physics.set_joint_properties(joint_, 0, properties);
  }
  read(physics);
}

}  // namespace ardee::control
