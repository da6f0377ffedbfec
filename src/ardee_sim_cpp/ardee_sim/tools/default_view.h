// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ardee_sim/raycast/bounds.h"
#include "ardee_sim/render/camera.h"

namespace ardee {

/// Camera pose above and beside the scene, from which all boxes fit into the picture. Grounds, much
/// wider than high, count only if there are no other boxes.
Pose view_over(const std::vector<raycast::Bounds>& boxes_W, const render::Camera& camera);

}  // namespace ardee
