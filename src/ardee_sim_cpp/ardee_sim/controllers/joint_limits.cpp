// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/joint_limits.h"

#include <algorithm>

#include "ardee_sim/core/error.h"

namespace ardee::control {
namespace {

/// Replaces a limit by the pair has_<name>_limits, max_<name>.
void override_limit(const Setting& group, const std::string& name, double& limit) {
  const std::string has = "has_" + name + "_limits";
  if (!group.has(has)) return;
  if (!group.boolean(has, false)) {
    limit = CommandLimits::kNone;
  } else if (group.has("max_" + name)) {
    limit = group.number("max_" + name);
    if (limit >= 0.0) return;
    throw Error(group.at("max_" + name).path() + ": found a limit below zero, expected none");
  }
}

void override_position(const Setting& group, CommandLimits& limits) {
  if (!group.has("has_position_limits")) return;
  if (!group.boolean("has_position_limits", false)) {
    limits.min_position = -CommandLimits::kNone;
    limits.max_position = CommandLimits::kNone;
  } else if (group.has("min_position") && group.has("max_position")) {
    limits.min_position = group.number("min_position");
    limits.max_position = group.number("max_position");
  }
}

}  // namespace

CommandLimits read_command_limits(const Joint& joint, const Setting& overrides, Log& log) {
  CommandLimits limits{joint.axis.lower,     joint.axis.upper,  joint.axis.velocity,
                       CommandLimits::kNone, joint.axis.effort, joint.safety};
  override_position(overrides, limits);
  override_limit(overrides, "velocity", limits.max_velocity);
  override_limit(overrides, "acceleration", limits.max_acceleration);
  override_limit(overrides, "effort", limits.max_effort);
  if (overrides.boolean("has_jerk_limits", false)) {
    log.warn_once(overrides.at("has_jerk_limits").path() +
                  " has no effect: no command is limited in jerk, as in ros_control");
  }
  return limits;
}

double CommandLimiter::Bounds::clamp(double value) const {
  return std::min(std::max(value, low), high);
}

CommandLimiter::Bounds CommandLimiter::soft_velocity(double position) const {
  const Bounds hard{-limits_.max_velocity, limits_.max_velocity};
  if (!limits_.has_position()) return hard;
  const SafetyLimits& soft = *limits_.soft;
  return {hard.clamp(-soft.k_position * (position - soft.soft_lower)),
          hard.clamp(-soft.k_position * (position - soft.soft_upper))};
}

CommandLimiter::Bounds CommandLimiter::position_bounds(const JointHandle& joint,
                                                       double dt_s) const {
  const double last = last_.value_or(joint.position);
  const Bounds velocity =
      limits_.soft ? soft_velocity(last) : Bounds{-limits_.max_velocity, limits_.max_velocity};
  return {std::max(last + velocity.low * dt_s, limits_.min_position),
          std::min(last + velocity.high * dt_s, limits_.max_position)};
}

CommandLimiter::Bounds CommandLimiter::velocity_bounds(const JointHandle& joint,
                                                       double dt_s) const {
  const Bounds most = limits_.soft ? soft_velocity(joint.position)
                                   : Bounds{-limits_.max_velocity, limits_.max_velocity};
  if (limits_.max_acceleration == CommandLimits::kNone) return most;
  const double last = limits_.soft ? joint.velocity : last_.value_or(0.0);
  const double change = limits_.max_acceleration * dt_s;
  return {std::max(last - change, most.low), std::min(last + change, most.high)};
}

CommandLimiter::Bounds CommandLimiter::effort_bounds(const JointHandle& joint) const {
  const Bounds most{-limits_.max_effort, limits_.max_effort};
  if (limits_.soft) {
    const Bounds velocity = soft_velocity(joint.position);
    const double gain = limits_.soft->k_velocity;
    return {most.clamp(-gain * (joint.velocity - velocity.low)),
            most.clamp(-gain * (joint.velocity - velocity.high))};
  }
  const bool is_below =
      joint.position < limits_.min_position || joint.velocity < -limits_.max_velocity;
  const bool is_above =
      joint.position > limits_.max_position || joint.velocity > limits_.max_velocity;
  return {is_below ? 0.0 : most.low, is_above ? 0.0 : most.high};
}

CommandLimiter::Bounds CommandLimiter::bounds(const JointHandle& joint, double dt_s) const {
  switch (joint.interface) {
    case JointInterface::kPosition:
      return position_bounds(joint, dt_s);
    case JointInterface::kVelocity:
      return velocity_bounds(joint, dt_s);
    case JointInterface::kEffort:
      break;
  }
  return effort_bounds(joint);
}

void CommandLimiter::enforce(JointHandle& joint, double dt_s) {
  joint.command = bounds(joint, dt_s).clamp(joint.command);
  last_ = joint.command;
}

}  // namespace ardee::control
