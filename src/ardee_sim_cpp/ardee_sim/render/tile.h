// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/render/renderer.h"

namespace ardee {

/// All that the shading of a part of a picture needs.
struct TileShading {
  const RayScene& rays;
  const Looks& looks;
  const Scene& scene;
  const std::vector<Light>& lights;
  const Camera& camera;
  const RenderOptions& options;
};

/// A part of a picture, in pixels.
struct TileArea {
  int left = 0;
  int upper = 0;
  int width = 0;
  int height = 0;
};

/// Computes the pixels of `area` and writes them into `image`.
void shade_tile(const TileShading& shading, const TileArea& area, Image& image);

}  // namespace ardee
