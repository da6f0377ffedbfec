// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/pid_controller.h"

#include "ardee_sim/controllers/joint_error.h"

namespace ardee::control {

PidController::PidController(const ControllerContext& context, JointInterface interface,
                             Quantity quantity, JointCount count)
    : quantity_(quantity) {
  const bool is_group = count == JointCount::kGroup;
  const Setting source = context.settings.at(is_group ? "joints" : "joint");
  for (const std::string& name : commanded_joints(context.settings, count)) {
    const std::string group = is_group ? name + "/pid" : "pid";
    JointHandle& handle = claim(context, name, interface, source);
    joints_.push_back({handle, Pid(read_pid_gains(context.settings.at(group), context.log))});
    ports().add(joints_.back().pid.tuning(context.topic(group)));
  }
  set_points_.resize(joints_.size());
  add_command_input(context, count, set_points_, ports());
  if (is_group) return;
  state_output_ = &ports().add_output(context.topic("state"),
                                      devices::reading_kind<devices::JointControllerReading>());
}

void PidController::start(TimeNs /*now_ns*/) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const JointHandle& joint = joints_[i].handle;
    set_points_[i] = quantity_ == Quantity::kPosition ? within_limits(joint, joint.position) : 0.0;
    joints_[i].pid.reset();
  }
}

void PidController::update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    JointHandle& joint = joints_[i].handle;
    joint.command = command(joints_[i], set_points_[i], now_ns, period_s, sink);
  }
}

double PidController::command(Joint& joint, double set_point, TimeNs now_ns, double period_s,
                              devices::ReadingSink& sink) {
  constexpr int kUpdatesAState = 10;
  const JointHandle& handle = joint.handle;
  const bool is_position = quantity_ == Quantity::kPosition;
  devices::JointControllerReading state;
  state.set_point = is_position ? within_limits(handle, set_point) : set_point;
  state.process_value = is_position ? handle.position : handle.velocity;
  state.process_value_dot = is_position ? handle.velocity : 0.0;
  state.error =
      is_position ? position_error(handle, state.set_point) : state.set_point - state.process_value;
  state.command = joint.pid.update(state.error, period_s);
  if (state_output_ && updates_++ % kUpdatesAState == 0 && state_output_->demanded) {
    const PidGains& gains = joint.pid.gains();
    state.header.stamp_ns = now_ns;
    state.time_step_s = period_s;
    state.p = gains.p;
    state.i = gains.i;
    state.d = gains.d;
    state.i_clamp = gains.i_clamp_max;
    state.antiwindup = gains.antiwindup;
    sink.on_reading(*state_output_, state);
  }
  return state.command;
}

void PidController::reset(TimeNs now_ns) {
  for (Joint& joint : joints_) joint.pid.restore_gains();
  start(now_ns);
  updates_ = 0;
}

}  // namespace ardee::control
