// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "ardee_sim/description/world.h"

namespace ardee::render {

/// Returns the colour for a ray without a hit: the scene's sky, paler towards the horizon, or its
/// background.
Eigen::Vector3f sky_color(const Scene& scene, const Eigen::Vector3d& direction_W);

/// Returns the ambient light on a surface with this normal. Under a sky, surfaces facing down get
/// less; without one, the scene's ambient light is the same everywhere.
Eigen::Vector3f ambient_light(const Scene& scene, const Eigen::Vector3d& normal_W);

}  // namespace ardee::render
