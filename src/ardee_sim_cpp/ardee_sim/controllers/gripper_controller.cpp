// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/gripper_controller.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ardee_sim/core/error.h"

namespace ardee::control {

GripperController::GripperController(const ControllerContext& context, JointInterface interface)
    : joint_(
          claim(context, context.settings.text("joint"), interface, context.settings.at("joint"))),
      goal_tolerance_(std::abs(context.settings.number("goal_tolerance", 0.01))),
      stall_velocity_(context.settings.number("stall_velocity_threshold", 0.001)),
      stall_timeout_ns_(nanoseconds(context.settings.number("stall_timeout", 1.0))),
      feedback_timer_(context.settings.number("action_monitor_rate", 20.0)) {
  default_.max_effort = std::abs(context.settings.number("max_effort", 0.0));
  if (interface == JointInterface::kEffort) {
    const std::string group = "gains/" + joint_.name;
    pid_.emplace(read_pid_gains(context.settings.at(group), context.log));
    ports().add(pid_->tuning(context.topic(group)));
  }
  devices::GripperAction action;
  action.name = context.topic("gripper_cmd");
  action.on_goal = [this](const devices::GripperGoal& goal,
                          const devices::GripperAction::HandlePtr& handle) {
    on_goal(goal, handle);
  };
  action.on_cancel = [this](const devices::GripperAction::HandlePtr& handle) { on_cancel(handle); };
  ports().add<devices::Action>(std::move(action));
}

void GripperController::start(TimeNs now_ns) {
  now_ns_ = last_movement_ns_ = now_ns;
  feedback_timer_.start(now_ns);
  effort_ = default_.max_effort;
  if (pid_) pid_->reset();
  hold();
}

void GripperController::stop(TimeNs /*now_ns*/) { preempt(); }

void GripperController::reset(TimeNs now_ns) {
  preempt();
  if (pid_) pid_->restore_gains();
  start(now_ns);
}

void GripperController::hold() { command_ = {joint_.position, default_.max_effort}; }

void GripperController::on_goal(const devices::GripperGoal& goal,
                                const devices::GripperAction::HandlePtr& handle) {
  std::string why;
  if (!is_running()) why = "found a goal, expected none while the controller is stopped";
  if (!std::isfinite(goal.position) || !std::isfinite(goal.max_effort)) {
    why = "command: found a number that is not finite";
  }
  if (!why.empty()) {
    handle->reject({joint_.position, effort_, false, false}, why);
    return;
  }
  preempt();
  handle->accept();
  goal_ = handle;
  command_ = goal;
  last_movement_ns_ = now_ns_;
}

void GripperController::on_cancel(const devices::GripperAction::HandlePtr& handle) {
  if (handle != goal_) return;
  hold();
  preempt();
}

void GripperController::preempt() {
  if (goal_) std::exchange(goal_, nullptr)->cancel();
}

void GripperController::update(TimeNs now_ns, double period_s, devices::ReadingSink& /*sink*/) {
  now_ns_ = now_ns;
  const double error = command_.position - joint_.position;
  check_goal(now_ns, error);
  if (pid_) {
    const double limit = std::abs(command_.max_effort);
    const double effort = pid_->update(error, -joint_.velocity, period_s);
    joint_.command = effort_ = std::min(std::max(effort, -limit), limit);
  } else {
    joint_.command = command_.position;
    effort_ = command_.max_effort;
  }
}

void GripperController::check_goal(TimeNs now_ns, double error) {
  if (!goal_) return;
  devices::GripperState state{joint_.position, effort_, false, std::abs(error) < goal_tolerance_};
  if (std::abs(joint_.velocity) > stall_velocity_) last_movement_ns_ = now_ns;
  state.is_stalled = !state.has_reached_goal && now_ns - last_movement_ns_ > stall_timeout_ns_;
  if (feedback_timer_.due(now_ns)) goal_->feed_back(state);
  if (state.has_reached_goal) {
    std::exchange(goal_, nullptr)->succeed(state);
  } else if (state.is_stalled) {
    std::exchange(goal_, nullptr)->abort(state);
  }
}

}  // namespace ardee::control
