// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/description/model.h"
#include "ardee_sim/readers/assets.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// Applies the <gazebo> blocks of a <robot> to the model: those with a reference to a link or
/// joint, the others to the model itself. An unknown element is a warning.
void apply_gazebo_blocks(const Node& root, Model& model, Assets& assets);

}  // namespace ardee
