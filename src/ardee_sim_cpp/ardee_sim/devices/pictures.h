// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/render/camera.h"
#include "ardee_sim/render/frame.h"

namespace ardee {

/// Takes pictures of the world as of this step. What it needs (textures, rays) is loaded when the
/// first one is taken.
class Pictures {
 public:
  virtual ~Pictures() = default;
  virtual Frame take(const Camera& camera, const FrameParts& parts) = 0;
};

}  // namespace ardee
