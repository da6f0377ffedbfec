// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/readers/image.h"
#include "ardee_sim/render/adaptive_tile.h"

namespace ardee::render {

/// What a thread works with, from tile to tile.
struct TileWorker {
  Shader shader;
  AdaptiveTile adaptive;
};

/// Computes the pixels of `area` and writes them into `image`. `worker` is the thread's own.
void shade_tile(const TileShading& shading, const TileArea& area, TileWorker& worker, Image& image);
/// The same for one sample a pixel, and for what else is wanted of the pixels.
void render_frame_tile(const TileShading& shading, const TileArea& area, const FrameParts& parts,
                       TileWorker& worker, Frame& frame);

}  // namespace ardee::render
