// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "ardee_sim/controllers/hardware.h"
#include "ardee_sim/controllers/joint_limits.h"
#include "ardee_sim/controllers/pid.h"
#include "ardee_sim/physics/physics_world.h"

namespace ardee::control {

/// Between a joint of the physics and its handle, as gazebo_ros_control's DefaultRobotHWSim: reads
/// what the joint does, and does each step what its command says. An effort acts as it is. A
/// position puts the joint there at once; a velocity is a motor's. That motor has at most the
/// effort limit, and replaces the joint's dry friction. With gains, an effort within the limit
/// follows position or velocity instead. Without any controller the command stays what it was, 0 at
/// first: that brakes a joint of velocities.
class JointActuator {
 public:
  /// `handle` outlives it; `joint` is the index in the physics.
  JointActuator(JointHandle& handle, std::size_t joint, const CommandLimits& limits,
                const std::optional<PidGains>& gains);

  void read(const physics::PhysicsModel& physics);
  /// Enforces the limits on the command, `dt_s` after the last one, and acts on the joint. An
  /// emergency stop holds positions, brakes velocities and leaves efforts away.
  void write(physics::PhysicsModel& physics, double dt_s, bool is_stopped);
  /// Of a physics that is as at the beginning: command 0.
  void reset(physics::PhysicsModel& physics);

  Pid* pid() { return pid_ ? &*pid_ : nullptr; }
  const JointHandle& handle() const { return handle_; }

 private:
  bool is_motor() const { return handle_.interface != JointInterface::kEffort && !pid_; }
  /// What the command asks for as an effort, before the joint's own limits.
  double wanted_effort(double dt_s, bool is_stopped);
  void push(physics::PhysicsModel& physics, double effort);

  JointHandle& handle_;
  std::size_t joint_;
  CommandLimiter limiter_;
  std::optional<Pid> pid_;
  std::optional<double> held_position_;  // during an emergency stop
};

}  // namespace ardee::control
