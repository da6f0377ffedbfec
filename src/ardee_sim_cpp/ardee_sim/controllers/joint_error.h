// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/controllers/hardware.h"

namespace ardee::control {

/// Angle wrapped to [-pi, pi].
double shortest_turn(double angle_rad);

/// Position clamped to the joint's limits, if its type has limits.
double within_limits(const JointHandle& joint, double position);

/// Error of a joint's position: the shortest turn of a continuous joint, the shortest turn within
/// its limits of a revolute joint, the difference for other joints.
double position_error(const JointHandle& joint, double position);

}  // namespace ardee::control
