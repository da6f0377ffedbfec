// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/controllers/hardware.h"

namespace ardee::control {

/// The same turn in [-pi, pi].
double shortest_turn(double angle_rad);

/// The position as far as the joint's limits allow: those of a revolute or prismatic joint.
double within_limits(const JointHandle& joint, double position);

/// How far the joint is from a position: of a continuous joint the shortest turn, of a revolute
/// joint the shortest that stays within its limits, of another the difference.
double position_error(const JointHandle& joint, double position);

}  // namespace ardee::control
