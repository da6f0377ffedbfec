// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/sensor_controllers.h"

#include "ardee_sim/devices/names.h"

namespace ardee::control {

std::unique_ptr<Controller> ImuSensorController::make(const ControllerContext& context) {
  return std::make_unique<ImuSensorController>(context);
}

ImuSensorController::ImuSensorController(const ControllerContext& context)
    : timer_(context.settings.number("publish_rate")) {
  if (context.sensors.imus.empty()) {
    context.log.warn(context.own_name() +
                     ": found no <sensor type='imu'> in the robot's description, expected some: "
                     "nothing is published");
  }
  for (const auto& [name, handle] : context.sensors.imus) {
    sensors_.emplace_back(&handle,
                          &ports().add_output(devices::resolve_topic(name, context.robot_namespace),
                                              devices::reading_kind<devices::ImuReading>()));
  }
}

void ImuSensorController::update(TimeNs now_ns, double /*period_s*/, devices::ReadingSink& sink) {
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

std::unique_ptr<Controller> ForceTorqueSensorController::make(const ControllerContext& context) {
  return std::make_unique<ForceTorqueSensorController>(context);
}

ForceTorqueSensorController::ForceTorqueSensorController(const ControllerContext& context)
    : timer_(context.settings.number("publish_rate")) {
  for (auto& [name, handle] : context.sensors.force_torques) {
    handle.is_wanted = true;
    sensors_.emplace_back(&handle,
                          &ports().add_output(devices::resolve_topic(name, context.robot_namespace),
                                              devices::reading_kind<devices::WrenchReading>()));
  }
}

void ForceTorqueSensorController::update(TimeNs now_ns, double /*period_s*/,
                                         devices::ReadingSink& sink) {
  if (!timer_.due(now_ns)) return;
  for (const auto& [handle, output] : sensors_) {
    if (output->demanded)
      sink.on_reading(*output, devices::WrenchReading{{now_ns, handle->frame}, handle->wrench});
  }
}

}  // namespace ardee::control
