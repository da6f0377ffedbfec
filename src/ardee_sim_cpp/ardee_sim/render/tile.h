// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/image/image.h"
#include "ardee_sim/render/adaptive_tile.h"

namespace ardee::render {

/// Memory of a thread that is reused from tile to tile.
struct TileWorker {
  Shader shader;
  AdaptiveTile adaptive;
};

/// Computes the pixels of `area` and writes them into `image`. `worker` is the thread's own.
void shade_tile(const TileShading& shading, const TileArea& area, TileWorker& worker, Image& image);
/// Does the same for one sample a pixel, and for the other requested data of the pixels.
void render_frame_tile(const TileShading& shading, const TileArea& area, const FrameParts& parts,
                       TileWorker& worker, Frame& frame);

}  // namespace ardee::render
