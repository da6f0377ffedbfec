// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/scenery.h"
#include "ardee_sim/raycast/ray_options.h"
#include "ardee_sim/render/camera.h"

namespace ardee {

/// Returns the number of pixels that a placement would cover if nothing hid it.
std::size_t lone_pixels(const Placement& placement, const render::Camera& camera,
                        const raycast::RayOptions& options, Log log);

}  // namespace ardee
