// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>

#include "ardee_sim/controllers/hardware.h"
#include "ardee_sim/core/log.h"
#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/description/setting.h"

namespace ardee::control {

/// Limits of a joint's commands; infinite if there is no limit. SI units: rad or m and their
/// derivatives, N m or N.
struct CommandLimits {
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  double min_position = -kNone;
  double max_position = kNone;
  double max_velocity = kNone;
  double max_acceleration = kNone;  // of velocity commands
  double max_effort = kNone;
  std::optional<SafetyLimits> soft;

  bool has_position() const { return max_position < kNone; }
};

/// The limits of a joint's description, replaced by those in `overrides`, a group
/// {has_position_limits, min_position, max_position, has_velocity_limits, max_velocity, ...} as
/// ros_control's <namespace>/joint_limits/<joint>. A limit whose has_... is false is off. Throws
/// Error if a value has another type.
CommandLimits read_command_limits(const Joint& joint, const Setting& overrides, Log& log);

/// Keeps a joint's commands within its limits as joint_limits_interface does: by saturation, or by
/// the soft limits if the joint has them.
class CommandLimiter {
 public:
  explicit CommandLimiter(const CommandLimits& limits) : limits_(limits) {}

  /// Limits the command of a joint, given `dt_s` after the last one.
  void enforce(JointHandle& joint, double dt_s);
  /// Forgets the last command.
  void reset() { last_.reset(); }
  void serialize(StateArchive& state) { state(last_); }
  const CommandLimits& limits() const { return limits_; }

 private:
  struct Bounds {
    double low;
    double high;
    double clamp(double value) const;
  };
  Bounds soft_velocity(double position) const;
  Bounds position_bounds(const JointHandle& joint, double dt_s) const;
  Bounds velocity_bounds(const JointHandle& joint, double dt_s) const;
  Bounds effort_bounds(const JointHandle& joint) const;
  Bounds bounds(const JointHandle& joint, double dt_s) const;

  CommandLimits limits_;
  std::optional<double> last_;  // the last command
};

}  // namespace ardee::control
