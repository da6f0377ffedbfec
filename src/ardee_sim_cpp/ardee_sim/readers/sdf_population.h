// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ardee_sim/readers/xml.h"

namespace ardee {

/// Where the models of a <population> stand, in its frame [m]: in its box or cylinder, whose middle
/// is the origin, as its <distribution> says. Random places follow from the population's name.
std::vector<Eigen::Vector3d> read_population(const Node& population);

}  // namespace ardee
