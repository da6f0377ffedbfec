// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/forward_controller.h"

#include <cmath>
#include <limits>

#include "ardee_sim/controllers/wheel_geometry.h"
#include "ardee_sim/core/error.h"

namespace ardee::control {

std::vector<std::string> commanded_joints(const Setting& settings, JointCount count) {
  if (count == JointCount::kOne) return {settings.text("joint")};
  settings.texts("joints");  // a single text is not a list
  return joint_names(settings, "joints");
}

void add_command_input(const ControllerContext& context, JointCount count,
                       std::vector<double>& commands, devices::Ports& ports) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  const std::string topic = context.topic("command");
  if (count == JointCount::kOne) {
    ports.add_number_input(topic, -kLargest, kLargest,
                           [&commands](double command) { commands[0] = command; });
    return;
  }
  ports.add_input<std::vector<double>>(topic, [&commands](const std::vector<double>& given) {
    if (given.size() != commands.size()) {
      throw Error("found " + std::to_string(given.size()) + " numbers, expected " +
                  std::to_string(commands.size()) + ", one a joint");
    }
    for (const double number : given) {
      if (!std::isfinite(number)) throw Error("found a command that is not finite");
    }
    commands = given;
  });
}

ForwardController::ForwardController(const ControllerContext& context, JointInterface interface,
                                     JointCount count)
    : interface_(interface) {
  const Setting source = context.settings.at(count == JointCount::kOne ? "joint" : "joints");
  for (const std::string& name : commanded_joints(context.settings, count)) {
    joints_.push_back(&claim(context, name, interface, source));
  }
  commands_.resize(joints_.size());
  add_command_input(context, count, commands_, ports());
}

void ForwardController::start(TimeNs /*now_ns*/) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    commands_[i] = interface_ == JointInterface::kPosition ? joints_[i]->position : 0.0;
  }
}

void ForwardController::update(TimeNs /*now_ns*/, double /*period_s*/,
                               devices::ReadingSink& /*sink*/) {
  for (std::size_t i = 0; i < joints_.size(); ++i) joints_[i]->command = commands_[i];
}

}  // namespace ardee::control
