// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "ardee_sim/controllers/controller.h"
#include "ardee_sim/controllers/pid.h"

namespace ardee::control {

/// Moves a gripper's joint to the goals of "gripper_cmd", until it arrives or stalls: {position,
/// effort}_controllers/GripperActionController. Efforts come from a PID law and are limited by the
/// goal.
class GripperController : public Controller {
 public:
  GripperController(const ControllerContext& context, JointInterface interface);

  void start(TimeNs now_ns) override;
  void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) override;
  void stop(TimeNs now_ns) override;
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override {
    state(pid_, feedback_timer_, command_, effort_, now_ns_, last_movement_ns_);
  }

 private:
  void hold();
  void on_goal(const devices::GripperGoal& goal, const devices::GripperAction::HandlePtr& handle);
  void on_cancel(const devices::GripperAction::HandlePtr& handle);
  void preempt();
  void check_goal(TimeNs now_ns, double error);

  JointHandle& joint_;
  std::optional<Pid> pid_;  // none: positions are commanded
  devices::GripperGoal default_;
  double goal_tolerance_;
  double stall_velocity_;
  TimeNs stall_timeout_ns_;
  PublishTimer feedback_timer_;

  devices::GripperGoal command_;
  double effort_ = 0.0;  // of the last update, for results
  TimeNs now_ns_ = 0;
  TimeNs last_movement_ns_ = 0;
  devices::GripperAction::HandlePtr goal_;
};

}  // namespace ardee::control
