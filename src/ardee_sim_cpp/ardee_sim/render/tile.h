// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/readers/image.h"
#include "ardee_sim/render/frame.h"
#include "ardee_sim/render/shader.h"

namespace ardee {

/// A part of a picture, in pixels.
struct TileArea {
  int left = 0;
  int upper = 0;
  int width = 0;
  int height = 0;
};

/// Computes the pixels of `area` and writes them into `image`. `shader` is the thread's own.
void shade_tile(const TileShading& shading, const TileArea& area, Shader& shader, Image& image);
/// The same for one sample a pixel, and for what else is wanted of the pixels.
void shoot_tile(const TileShading& shading, const TileArea& area, const FrameParts& parts,
                Shader& shader, Frame& frame);

}  // namespace ardee
