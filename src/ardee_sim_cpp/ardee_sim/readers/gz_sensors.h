// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/model.h"

namespace ardee {

/// Adds a stock plugin to those sensors of a link that newer Gazebo publishes without one: sensors
/// of its own types, and sensors of other types that name a <topic>. Satellite receivers and
/// magnetometers become plugins of the model.
void adopt_gz_sensors(Link& link, std::vector<PluginDescription>& model_plugins, Log& log);

/// Adds a key to a plugin's block.
void add_key(PluginDescription& plugin, const std::string& name, const std::string& text);

}  // namespace ardee
