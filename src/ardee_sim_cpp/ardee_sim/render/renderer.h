// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "ardee_sim/description/world.h"
#include "ardee_sim/raycast/ray_scene.h"
#include "ardee_sim/readers/image.h"
#include "ardee_sim/render/camera.h"
#include "ardee_sim/render/looks.h"

namespace ardee {

struct RenderOptions {
  int samples = 4;  // rays a pixel, in a fixed pattern
  bool shadows = true;
  int threads = 0;  // 0: all cores
  double max_range_m = 1e5;
};

/// Pictures of a scene: the same world and camera give the same bytes, whatever the threads.
class Renderer {
 public:
  /// Called with the share that is done, from several threads; false stops the work.
  using Progress = std::function<bool(double)>;

  /// `rays` (of the visual scene, prepared) and `looks` are kept by reference.
  Renderer(const RayScene& rays, const Looks& looks, const Scene& scene, std::vector<Light> lights)
      : rays_(rays), looks_(looks), scene_(scene), lights_(std::move(lights)) {}

  /// Eight bits of red, green, blue and opacity. Empty if `progress` stopped it.
  Image render(const Camera& camera, const RenderOptions& options,
               const Progress& progress = nullptr) const;

 private:
  const RayScene& rays_;
  const Looks& looks_;
  const Scene scene_;
  const std::vector<Light> lights_;
};

}  // namespace ardee
