// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "ardee_sim/description/model.h"
#include "ardee_sim/readers/assets.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// Reads a URDF with its <gazebo> blocks; `root` is the <robot> of the parsed `text`. All links are
/// kept, massless ones and those on fixed joints too. A root link named "world" stands for the
/// world.
std::shared_ptr<const Model> read_urdf(const std::string& text, const Node& root, Assets& assets);

}  // namespace ardee
