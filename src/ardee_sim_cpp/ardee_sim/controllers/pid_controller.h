// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <vector>

#include "ardee_sim/controllers/forward_controller.h"
#include "ardee_sim/controllers/pid.h"

namespace ardee::control {

/// The controllers that move joints to the set points of "command" by a PID law:
/// effort_controllers/{JointPosition, JointVelocity, JointGroupPosition}Controller and
/// velocity_controllers/JointPositionController.
class PidController : public Controller {
 public:
  enum class Quantity { kPosition, kVelocity };

  PidController(const ControllerContext& context, JointInterface interface, Quantity quantity,
                JointCount count);

  /// Holds the present positions, or commands velocities of 0.
  void start(TimeNs now_ns) override;
  void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) override;
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override {
    state(set_points_, updates_);
    for (Joint& each : joints_) state(each.pid);
  }

 private:
  struct Joint {
    JointHandle& handle;
    Pid pid;
  };

  /// Computes the joint's command towards its set point, and publishes the state if it is due.
  double command(Joint& joint, double set_point, TimeNs now_ns, double period_s,
                 devices::ReadingSink& sink);

  Quantity quantity_;
  std::deque<Joint> joints_;  // tunings point to them
  std::vector<double> set_points_;
  devices::Output* state_output_ = nullptr;  // of a single joint
  int updates_ = 0;
};

}  // namespace ardee::control
