// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ardee_sim/controllers/controller.h"

namespace ardee::control {

/// Whether a controller commands the joint that "joint" names, by a number, or those that "joints"
/// names, by a list of numbers.
enum class JointCount { kOne, kGroup };

/// The controllers that pass "command" on to joints: {position, velocity,
/// effort}_controllers/{JointPosition, JointVelocity, JointEffort, JointGroup...}Controller.
class ForwardController : public Controller {
 public:
  ForwardController(const ControllerContext& context, JointInterface interface, JointCount count);

  /// Holds the present positions, or commands velocities and efforts of 0.
  void start(TimeNs now_ns) override;
  void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) override;
  void reset(TimeNs now_ns) override { start(now_ns); }
  void serialize(StateArchive& state) override { state(commands_); }

 private:
  JointInterface interface_;
  std::vector<JointHandle*> joints_;
  std::vector<double> commands_;
};

/// The joints that a controller's settings name.
std::vector<std::string> commanded_joints(const Setting& settings, JointCount count);

/// Stores messages of "command" in `commands`, which has the right size and outlives the ports: one
/// number, or one per joint. Another count, or a number that is not finite, is an Error.
void add_command_input(const ControllerContext& context, JointCount count,
                       std::vector<double>& commands, devices::Ports& ports);

}  // namespace ardee::control
