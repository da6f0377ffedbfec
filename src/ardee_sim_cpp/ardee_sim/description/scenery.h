// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/description/model.h"

namespace ardee {

/// One static description at one place in the world: a plant, a ground, a box. Position p_W = X_WM
/// * (scale * p_M).
struct Placement {
  std::shared_ptr<const Model> model;  // its own links only, not model->instances
  Pose X_WM;
  double scale = 1.0;
  std::uint32_t label = 0;
};

/// Placements of a static instance and of all that it includes at any depth, in the order of the
/// description. A model without links of its own gives no placement.
std::vector<Placement> flatten_scenery(const Instance& instance);

/// Scoped names of the placements' models, in the order of flatten_scenery: "field::corn_7".
using PlacementNames = std::function<std::string(std::size_t placement)>;
PlacementNames placement_names(const Instance& instance);

}  // namespace ardee
