// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/model.h"

namespace ardee {

/// Reads librealsense_gazebo_plugin.so, a plugin of the model that publishes for the sensors
/// "<prefix>color", "<prefix>ired1", "<prefix>ired2" and "<prefix>depth", as a stock camera plugin
/// in each of them. Its topics are below its own name, as in Gazebo; frame names are used
/// unchanged.
void adopt_realsense(Model& model, Log& log);

}  // namespace ardee
