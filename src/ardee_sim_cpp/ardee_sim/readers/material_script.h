// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/material.h"

namespace ardee {

/// The materials of an OGRE script by name; Material::texture_path holds the file name as written.
using MaterialScript = std::map<std::string, Material>;

/// Reads the materials of an OGRE script: for each the first technique, its colours, cull modes,
/// alpha rejection and first texture. Other entries of a script are skipped. `known` holds the
/// materials that may serve as parents. A malformed material is left out with a warning. Throws
/// Error with `name` and the line if a block does not end.
MaterialScript parse_material_script(const std::string& text, const std::string& name, Log& log,
                                     const MaterialScript& known = {});

/// Gazebo's built-in colours (Gazebo/Grey, Gazebo/Orange, ...).
const MaterialScript& gazebo_materials();

}  // namespace ardee
