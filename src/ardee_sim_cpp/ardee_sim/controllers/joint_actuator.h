// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "ardee_sim/controllers/hardware.h"
#include "ardee_sim/controllers/joint_limits.h"
#include "ardee_sim/controllers/pid.h"
#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/physics/physics_world.h"

namespace ardee::control {

/// Connects a joint of the physics with its handle, as gazebo_ros_control's DefaultRobotHWSim does:
/// reads the joint's state, and applies the handle's command each step. An effort acts directly. A
/// position command sets the joint's position at once; a velocity command drives a motor. That
/// motor has at most the effort limit, and replaces the joint's dry friction. With gains, an effort
/// within the limit follows position or velocity instead. Without a controller the last command
/// holds, 0 at first, which brakes a joint with velocity commands.
class JointActuator {
 public:
  /// `handle` outlives it; `joint` is the index in the physics.
  JointActuator(JointHandle& handle, std::size_t joint, const CommandLimits& limits,
                const std::optional<PidGains>& gains);

  void read(const physics::PhysicsModel& physics);
  /// Enforces the limits on the command, `dt_s` after the last one, and acts on the joint. An
  /// emergency stop holds positions, brakes velocities and applies no effort.
  void write(physics::PhysicsModel& physics, double dt_s, bool is_stopped);
  /// Sets the command to 0, for a physics that was reset.
  void reset(physics::PhysicsModel& physics);
  void serialize(StateArchive& state) { state(limiter_, pid_, held_position_); }

  Pid* pid() { return pid_ ? &*pid_ : nullptr; }
  const JointHandle& handle() const { return handle_; }

 private:
  bool is_motor() const { return handle_.interface != JointInterface::kEffort && !pid_; }
  /// Effort that the command demands, before the joint's own limits.
  double wanted_effort(double dt_s, bool is_stopped);
  void push(physics::PhysicsModel& physics, double effort);

  JointHandle& handle_;
  std::size_t joint_;
  CommandLimiter limiter_;
  std::optional<Pid> pid_;
  std::optional<double> held_position_;  // during an emergency stop
};

}  // namespace ardee::control
