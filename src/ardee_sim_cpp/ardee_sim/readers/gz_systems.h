// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/model.h"

namespace ardee {

/// Reads what newer Gazebo (gz sim, Ignition) has for the stock plugins' work as those plugins:
/// systems (gz-sim-diff-drive-system) and sensors that publish without a plugin. What has no
/// counterpart is left out with a warning.
void adopt_gz_systems(Model& model, Log& log);

/// Whether a plugin of a world is a system of newer Gazebo that does what happens here anyway
/// (physics, sensors, user commands).
bool is_settled_gz_system(const PluginDescription& plugin);

}  // namespace ardee
