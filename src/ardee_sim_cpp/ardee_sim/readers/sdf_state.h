// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/world.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// Puts the clock, models, links and lights of a world to where its <state> says, which Gazebo
/// writes where it saves a world, and takes out what is in <deletions>. Poses of links are in the
/// world's frame. One warning names what the world does not have.
void apply_sdf_state(const Node& state, World& world, Log& log);

}  // namespace ardee
