// SPDX-License-Identifier: MIT
#include <utility>
#include <vector>

#include "ardee_sim/controllers/controller.h"
#include "ardee_sim/controllers/controller_types.h"
#include "ardee_sim/devices/names.h"

namespace ardee::control {
namespace {

/// imu_sensor_controller/ImuSensorController: publishes each ImuHandle on the topic of its name, in
/// the robot's namespace, at `publish_rate` (Hz).
class ImuSensorController : public Controller {
 public:
  explicit ImuSensorController(const ControllerContext& context)
      : timer_(context.settings.number("publish_rate")) {
    if (context.sensors.imus.empty()) {
      context.log.warn(context.own_name() +
                       ": found no <sensor type='imu'> in the robot's description, expected some: "
                       "nothing is published");
    }
    for (const auto& [name, handle] : context.sensors.imus) {
      sensors_.emplace_back(
          &handle, &ports().add_output(devices::resolve_topic(name, context.robot_namespace),
                                       devices::reading_kind<devices::ImuReading>()));
    }
  }

  void start(TimeNs now_ns) override { timer_.start(now_ns); }
  void update(TimeNs now_ns, double /*period_s*/, devices::ReadingSink& sink) override {
    if (!timer_.due(now_ns)) return;
    for (const auto& [handle, output] : sensors_) {
      if (!output->demanded) continue;
      devices::ImuReading reading;
      reading.header = {now_ns, handle->frame};
      reading.orientation = handle->orientation;
      reading.angular_velocity = handle->angular_velocity;
      reading.linear_acceleration = handle->linear_acceleration;
      sink.on_reading(*output, reading);
    }
  }
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
  explicit ForceTorqueSensorController(const ControllerContext& context)
      : timer_(context.settings.number("publish_rate")) {
    for (auto& [name, handle] : context.sensors.force_torques) {
      handle.is_wanted = true;
      sensors_.emplace_back(
          &handle, &ports().add_output(devices::resolve_topic(name, context.robot_namespace),
                                       devices::reading_kind<devices::WrenchReading>()));
    }
  }

  void start(TimeNs now_ns) override { timer_.start(now_ns); }
  void update(TimeNs now_ns, double /*period_s*/, devices::ReadingSink& sink) override {
    if (!timer_.due(now_ns)) return;
    for (const auto& [handle, output] : sensors_) {
      if (output->demanded)
        sink.on_reading(*output, devices::WrenchReading{{now_ns, handle->frame}, handle->wrench});
    }
  }
  void reset(TimeNs now_ns) override { timer_.start(now_ns); }
  void serialize(StateArchive& state) override { state(timer_); }

 private:
  PublishTimer timer_;
  std::vector<std::pair<const ForceTorqueHandle*, devices::Output*>> sensors_;
};

}  // namespace

std::unique_ptr<Controller> make_imu_sensor(const ControllerContext& context) {
  return std::make_unique<ImuSensorController>(context);
}

std::unique_ptr<Controller> make_force_torque_sensor(const ControllerContext& context) {
  return std::make_unique<ForceTorqueSensorController>(context);
}

}  // namespace ardee::control
