// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <vector>

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/model.h"

namespace ardee {

/// Replaces systems of newer Gazebo (gz sim, Ignition) such as gz-sim-diff-drive-system, and
/// sensors that publish without a plugin, with the corresponding stock plugins. A system without a
/// counterpart is left out with a warning.
void adopt_gz_systems(Model& model, Log& log);

/// A system of newer Gazebo by its name without "gz-sim-" and "-system", the stock plugin that does
/// its work, and a note for the log, if any.
struct GzCounterpart {
  std::string system;
  std::string plugin;
  std::string warning;
};
std::vector<GzCounterpart> gz_counterparts();
/// Systems whose work the simulator always does.
const std::set<std::string>& settled_gz_systems();

/// Whether a plugin of a world is a system of newer Gazebo whose work the simulator always does
/// (physics, sensors, user commands).
bool is_settled_gz_system(const PluginDescription& plugin);

}  // namespace ardee
