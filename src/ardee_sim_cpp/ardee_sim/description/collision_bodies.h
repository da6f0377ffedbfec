// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "ardee_sim/description/model.h"

namespace ardee {

/// Returns a model whose visuals are the collision bodies of the given one's own links, transparent
/// and orange as in Gazebo (thesis Figure 4.3). It lacks grounds and the meshes that a visual of
/// their link shows already; boxes, spheres and cylinders are a little larger, so that a visual of
/// the same size shows through.
std::shared_ptr<const Model> collision_bodies(const Model& model);

}  // namespace ardee
