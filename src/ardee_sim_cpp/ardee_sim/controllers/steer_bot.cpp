// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/steer_bot.h"

#include <algorithm>
#include <cmath>

#include "ardee_sim/controllers/wheel_geometry.h"
#include "ardee_sim/core/error.h"
#include "ardee_sim/core/nearest_names.h"

namespace ardee::control {
namespace {

bool has_joint(const Model& model, const std::string& name) {
  return std::any_of(model.joints.begin(), model.joints.end(),
                     [&name](const Joint& joint) { return joint.name == name; });
}

/// Joints of the car that a parameter names, or none.
std::vector<std::string> car_joints(const Setting& settings, const std::string& key,
                                    const Model& model) {
  if (!settings.has(key)) return {};
  const std::vector<std::string> names = settings.texts(key);
  for (const std::string& name : names) {
    if (has_joint(model, name)) continue;
    std::vector<std::string> known;
    for (const Joint& joint : model.joints) known.push_back(joint.name);
    throw Error(
        settings.at(key).path() + ": found joint '" + name +
        "', expected one of the robot's description; nearest: " + nearest_names(name, known));
  }
  return names;
}

/// Whether the knuckles follow Ackermann's geometry. A value that is not a boolean, such as 'true'
/// in quotes, is ignored, as in the original.
bool is_linked(const Setting& settings, Log& log) {
  const Setting given = settings.at("enable_ackermann_link");
  if (const bool* value = std::get_if<bool>(&given.value())) return *value;
  if (given)
    log.warn(given.path() + ": found no truth value, expected true or false; true is taken");
  return true;
}

/// Warns of each parameter that is not read.
void warn_of_unused(const Setting& settings, Log& log) {
  static const std::vector<std::string> kKnown{"rear_wheel",           "front_steer",
                                               "virtual_rear_wheels",  "virtual_front_wheels",
                                               "virtual_front_steers", "enable_ackermann_link",
                                               "wheel_separation_w",   "wheel_separation_h"};
  for (const auto& [key, setting] : settings.group("a group of parameters")) {
    if (std::find(kKnown.begin(), kKnown.end(), key) != kKnown.end()) continue;
    log.warn(setting.path() + (key == "gains" ? ": has no effect: joints follow at once"
                                              : ": found an unknown parameter, nearest: " +
                                                    nearest_names(key, kKnown)));
  }
}

}  // namespace

SteerBot::SteerBot(const Setting& settings, const Model& model, Log& log)
    : rear_wheel_(settings.text("rear_wheel")),
      front_steer_(settings.text("front_steer")),
      has_rear_wheel_(has_joint(model, rear_wheel_)),
      has_front_steer_(has_joint(model, front_steer_)) {
  warn_of_unused(settings, log);
  joints_[rear_wheel_] = JointInterface::kVelocity;
  joints_[front_steer_] = JointInterface::kPosition;
  for (const char* key : {"virtual_rear_wheels", "virtual_front_wheels"}) {
    for (const std::string& joint : car_joints(settings, key, model)) {
      joints_[joint] = JointInterface::kVelocity;
      wheels_.push_back(joint);
    }
  }
  if (wheels_.empty()) {
    log.warn(settings.path() +
             ": found neither virtual_rear_wheels nor virtual_front_wheels, expected joints");
  }
  double half_track_m = 0.0;
  if (is_linked(settings, log)) {
    wheel_base_m_ =
        positive(settings.number("wheel_separation_h"), settings.at("wheel_separation_h"));
    half_track_m = 0.5 * settings.number("wheel_separation_w");
  }
  for (const std::string& joint : car_joints(settings, "virtual_front_steers", model)) {
    const double y_m = joint_origin(model, joint, settings.at("virtual_front_steers")).y();
    joints_[joint] = JointInterface::kPosition;
    knuckles_.push_back({joint, std::copysign(half_track_m, y_m)});
  }
}

void SteerBot::reset(Hardware& hardware) const {
  if (!has_rear_wheel_) {
    JointHandle& wheel = hardware.at(rear_wheel_);
    wheel.position = wheel.velocity = wheel.command = 0.0;
  }
  if (!has_front_steer_) {
    JointHandle& steer = hardware.at(front_steer_);
    steer.position = steer.command = 0.0;
  }
}

void SteerBot::follow(Hardware& hardware, double dt_s) const {
  JointHandle& wheel = hardware.at(rear_wheel_);
  JointHandle& steer = hardware.at(front_steer_);
  if (!has_rear_wheel_) {
    wheel.velocity = wheel.command;
    wheel.position += wheel.command * dt_s;
  }
  if (!has_front_steer_) steer.position = steer.command;
  for (const std::string& each : wheels_) hardware.at(each).command = wheel.command;
  const double rise = wheel_base_m_ * std::tan(steer.command);
  for (const Knuckle& each : knuckles_) {
    const double run_m = wheel_base_m_ - each.y_m * std::tan(steer.command);
    hardware.at(each.joint).command = std::atan2(rise, run_m);
  }
}

}  // namespace ardee::control
