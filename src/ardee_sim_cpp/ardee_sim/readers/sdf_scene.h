// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/world.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// Parts of a world other than models.
Light read_sdf_light(const Node& light, const Pose& X_WL);
Scene read_sdf_scene(const Node& scene);
SphericalCoordinates read_spherical_coordinates(const Node& coordinates);
/// <physics> (the default one of several) and <gravity> of a <world>.
PhysicsParams read_sdf_physics(const Node& world, Log& log);

}  // namespace ardee
