// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ardee_sim/description/world.h"
#include "ardee_sim/raycast/ray_scene.h"
#include "ardee_sim/readers/image.h"
#include "ardee_sim/render/camera.h"
#include "ardee_sim/render/frame.h"
#include "ardee_sim/render/looks.h"

namespace ardee {

struct RenderOptions {
  int samples = 4;  // rays a pixel, in a fixed pattern
  bool shadows = true;
  int threads = 0;  // 0: all cores
  double max_range_m = 1e5;
  /// RayScene::look_quickly, and fewer looks where a surface is even (shoot only).
  bool quickly = false;
};

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
/// The same for one sample a pixel, and for what else is wanted of the pixels.
void shoot_tile(const TileShading& shading, const TileArea& area, const FrameParts& parts,
                Frame& frame);

}  // namespace ardee
