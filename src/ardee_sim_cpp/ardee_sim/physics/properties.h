// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>

#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/description/model.h"

namespace ardee::physics {

/// Properties of a link that can be changed while it moves. Links that fixed joints hold together
/// move by the sum of their properties.
struct LinkProperties {
  std::optional<Inertial> inertial;  // none: massless
  bool gravity = true;

  bool operator==(const LinkProperties& other) const;
  void serialize(StateArchive& state) { state(inertial, gravity); }
};

/// A spring and damper about a joint's axis, with limits: tau = -damping * rate - stiffness *
/// (angle - reference) (thesis eq. 4.1), integrated implicitly, so that it is stable at any step.
struct JointSpring {
  double stiffness = 0.0;  // N m/rad (N/m)
  double damping = 0.0;    // N m s/rad (N s/m)
  double reference = 0.0;  // rad (m)
};

/// Drives an axis towards `velocity` with at most `max_effort`; 0 lets it coast.
struct JointMotor {
  double velocity = 0.0;    // rad/s (m/s)
  double max_effort = 0.0;  // N m (N)
};

/// Properties of one joint axis that can be changed while it moves. SI units: rad or m, N m or N.
struct JointProperties {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  /// Bound the efforts that are applied to the axis, not its motor: beyond the velocity no effort
  /// acts in the direction of the motion.
  double max_effort = std::numeric_limits<double>::infinity();
  double max_velocity = std::numeric_limits<double>::infinity();
  double friction = 0.0;
  JointSpring spring;
  // ODE's correction (ERP) and softness (CFM) at the stops, and softness of the motor; negative:
  // the world's.
  double stop_erp = -1.0;
  double stop_cfm = -1.0;
  double motor_cfm = -1.0;
};

}  // namespace ardee::physics
