// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/description/model.h"
#include "ardee_sim/readers/assets.h"
#include "ardee_sim/readers/sdf_frames.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// An SDF <link> with all its parts; it is one of the model's `frames`. Throws Error with file and
/// line.
Link read_sdf_link(const Node& link, const SdfFrames& frames, Assets& assets);

/// Applies the <surface> and <max_contacts> of a <collision> to `made`.
Surface read_sdf_surface(const Node& collision, Surface made = {});

/// Reads a <mu>: a negative value is infinite, as in Gazebo; an empty one is `otherwise`.
double read_friction(const Node& mu, double otherwise);

SensorDescription read_sensor(const Node& sensor, const Pose& X_LS);
PluginDescription read_plugin(const Node& plugin);

}  // namespace ardee
