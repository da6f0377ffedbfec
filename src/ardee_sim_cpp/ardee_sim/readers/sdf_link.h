// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/description/model.h"
#include "ardee_sim/readers/assets.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// An SDF <link> with all it holds. Throws Error with file and line.
Link read_sdf_link(const Node& link, Assets& assets);

/// `made` with what a <collision>'s <surface> and <max_contacts> say.
Surface read_sdf_surface(const Node& collision, Surface made = {});

SensorDescription read_sensor(const Node& sensor);
PluginDescription read_plugin(const Node& plugin);

}  // namespace ardee
