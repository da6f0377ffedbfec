// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ardee_sim/readers/xml.h"

namespace ardee {

/// Positions of the models of a <population>, in its frame [m]: within its box or cylinder, centred
/// at the origin, by its <distribution>. The population's name seeds random positions.
std::vector<Eigen::Vector3d> read_population(const Node& population);

}  // namespace ardee
