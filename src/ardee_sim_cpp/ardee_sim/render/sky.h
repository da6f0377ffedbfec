// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "ardee_sim/description/world.h"

namespace ardee::render {

/// What is seen where a ray meets nothing: the scene's sky, paler towards the horizon, or its
/// background.
Eigen::Vector3f sky_color(const Scene& scene, const Eigen::Vector3d& direction_W);

/// The light from all around that falls on a surface with this normal. Under a sky, what faces
/// down gets less of it; without one it is the scene's ambient light everywhere.
Eigen::Vector3f ambient_light(const Scene& scene, const Eigen::Vector3d& normal_W);

}  // namespace ardee::render
