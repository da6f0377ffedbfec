// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "ardee_sim/description/world.h"

namespace ardee::render {

/// Light that a point gets from one source if no body is between.
struct Illumination {
  Eigen::Vector3d to_light_W;  // unit
  double distance_m = 0.0;     // infinite for a directional light
  Eigen::Vector3f color{0, 0, 0};
};

/// Returns none if the light does not reach the point.
std::optional<Illumination> illuminate(const Light& light, const Eigen::Vector3d& point_W);

}  // namespace ardee::render
