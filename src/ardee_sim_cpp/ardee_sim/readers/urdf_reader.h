// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "ardee_sim/description/model.h"
#include "ardee_sim/readers/assets.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// Reads a <robot> with its <gazebo> blocks (http://wiki.ros.org/urdf/XML). All links are kept,
/// massless ones and those on fixed joints too. A root link named "world" stands for the world.
std::shared_ptr<const Model> read_urdf(const Node& robot, Assets& assets);

}  // namespace ardee
