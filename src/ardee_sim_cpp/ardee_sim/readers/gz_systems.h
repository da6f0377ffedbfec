// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <vector>

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/model.h"

namespace ardee {

/// Reads what newer Gazebo (gz sim, Ignition) has for the stock plugins' work as those plugins:
/// systems (gz-sim-diff-drive-system) and sensors that publish without a plugin. What has no
/// counterpart is left out with a warning.
void adopt_gz_systems(Model& model, Log& log);

/// A system of newer Gazebo by its name without "gz-sim-" and "-system", the stock plugin that does
/// its work, and what is said of it, if anything.
struct GzCounterpart {
  std::string system;
  std::string plugin;
  std::string warning;
};
std::vector<GzCounterpart> gz_counterparts();
/// Systems that do what happens here anyway.
const std::set<std::string>& settled_gz_systems();

/// Whether a plugin of a world is a system of newer Gazebo that does what happens here anyway
/// (physics, sensors, user commands).
bool is_settled_gz_system(const PluginDescription& plugin);

}  // namespace ardee
