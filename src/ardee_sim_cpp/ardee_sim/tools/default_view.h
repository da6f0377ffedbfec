// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ardee_sim/raycast/bounds.h"
#include "ardee_sim/render/camera.h"

namespace ardee {

/// A place from above and aside from which all boxes fit into the camera's picture. Grounds, much
/// wider than high, count only if there is nothing else.
Pose view_over(const std::vector<raycast::Bounds>& boxes_W, const render::Camera& camera);

}  // namespace ardee
