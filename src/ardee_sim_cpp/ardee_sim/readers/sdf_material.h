// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/readers/assets.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// An SDF <material>: its script's material, or Gazebo's, with the colours given beside it taking
/// precedence.
Material read_sdf_material(const Node& material, Assets& assets);

}  // namespace ardee
