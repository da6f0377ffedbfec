// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "ardee_sim/controllers/controller.h"

namespace ardee::control {

/// joint_state_controller/JointStateController: publishes the states of the hardware's joints on
/// "joint_states" of the robot.
class JointStateController : public Controller {
 public:
  static std::unique_ptr<Controller> make(const ControllerContext& context);
  explicit JointStateController(const ControllerContext& context);

  void start(TimeNs now_ns) override;
  void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) override;
  void reset(TimeNs now_ns) override { start(now_ns); }
  void serialize(StateArchive& state) override { state(timer_); }

 private:
  void add_extra_joints(const ControllerContext& context);

  std::vector<const JointHandle*> joints_;
  devices::JointStateReading
      reading_;  // joints of the hardware first, then those that never change
  PublishTimer timer_;
  devices::Output& output_;
};

}  // namespace ardee::control
