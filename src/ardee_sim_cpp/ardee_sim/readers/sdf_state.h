// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/world.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// Sets the clock, models, links and lights of a world to its <state>, which Gazebo writes when it
/// saves a world, and removes the models in <deletions>. Poses of links are in the world's frame.
/// One warning names the entries that the world does not have.
void apply_sdf_state(const Node& state, World& world, Log& log);

}  // namespace ardee
