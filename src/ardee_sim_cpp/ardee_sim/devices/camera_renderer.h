// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/render/camera.h"
#include "ardee_sim/render/frame.h"

namespace ardee::devices {

/// Takes pictures of the world as of this step. Textures and ray scenes are loaded for the first
/// picture.
class CameraRenderer {
 public:
  virtual ~CameraRenderer() = default;
  virtual render::Frame take(const render::Camera& camera, const render::FrameParts& parts) = 0;
};

}  // namespace ardee::devices
