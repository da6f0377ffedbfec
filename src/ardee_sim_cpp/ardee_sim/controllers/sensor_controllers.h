// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "ardee_sim/controllers/controller.h"

namespace ardee::control {

/// imu_sensor_controller/ImuSensorController: publishes each ImuHandle on the topic of its name, in
/// the robot's namespace, at `publish_rate` (Hz).
class ImuSensorController : public Controller {
 public:
  static std::unique_ptr<Controller> make(const ControllerContext& context);
  explicit ImuSensorController(const ControllerContext& context);

  void start(TimeNs now_ns) override { timer_.start(now_ns); }
  void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) override;
  void reset(TimeNs now_ns) override { timer_.start(now_ns); }
  void serialize(StateArchive& state) override { state(timer_); }

 private:
  PublishTimer timer_;
  std::vector<std::pair<const ImuHandle*, devices::Output*>> sensors_;
};

/// force_torque_sensor_controller/ForceTorqueSensorController: publishes each ForceTorqueHandle in
/// this way.
class ForceTorqueSensorController : public Controller {
 public:
  static std::unique_ptr<Controller> make(const ControllerContext& context);
  explicit ForceTorqueSensorController(const ControllerContext& context);

  void start(TimeNs now_ns) override { timer_.start(now_ns); }
  void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) override;
  void reset(TimeNs now_ns) override { timer_.start(now_ns); }
  void serialize(StateArchive& state) override { state(timer_); }

 private:
  PublishTimer timer_;
  std::vector<std::pair<const ForceTorqueHandle*, devices::Output*>> sensors_;
};

}  // namespace ardee::control
