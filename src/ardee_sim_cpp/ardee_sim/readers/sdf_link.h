// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/description/model.h"
#include "ardee_sim/readers/assets.h"
#include "ardee_sim/readers/sdf_frames.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// An SDF <link> with all it holds, one of the model's `frames`. Throws Error with file and line.
Link read_sdf_link(const Node& link, const SdfFrames& frames, Assets& assets);

/// `made` with what a <collision>'s <surface> and <max_contacts> say.
Surface read_sdf_surface(const Node& collision, Surface made = {});

/// A <mu>: a negative one is infinite, as in Gazebo; `otherwise` where it is empty.
double read_friction(const Node& mu, double otherwise);

SensorDescription read_sensor(const Node& sensor, const Pose& X_LS);
PluginDescription read_plugin(const Node& plugin);

}  // namespace ardee
