// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "ardee_sim/description/world.h"
#include "ardee_sim/raycast/picture_tracer.h"
#include "ardee_sim/readers/image.h"
#include "ardee_sim/render/camera.h"
#include "ardee_sim/render/frame.h"
#include "ardee_sim/render/material_library.h"
#include "ardee_sim/render/radiance_cache.h"
#include "ardee_sim/render/tile.h"

namespace ardee::render {

/// Draws pictures of a scene: the same world and camera give the same bytes, whatever the threads.
class Renderer {
 public:
  /// Called with the share that is done, from several threads; false stops the work.
  using Progress = std::function<bool(double)>;

  /// `rays` (of the visual scene, prepared) and `materials` are kept by reference.
  Renderer(const raycast::PictureTracer& rays, const MaterialLibrary& materials, const Scene& scene,
           std::vector<Light> lights)
      : rays_(rays), materials_(materials), scene_(scene), lights_(std::move(lights)) {}

  const raycast::PictureTracer& rays() const { return rays_; }

  /// Eight bits of red, green, blue and opacity. Empty if `progress` stopped it.
  Image render(const Camera& camera, const RenderOptions& options,
               const Progress& progress = nullptr) const;

  /// What a sensor behind that lens receives, a ray through the middle of each pixel;
  /// `options.samples` is not looked at.
  Frame render_frame(const Camera& camera, const FrameParts& parts,
                     const RenderOptions& options) const;

 private:
  /// Calls `work(tile, worker)` for each tile of the picture, in parallel.
  static void for_each_tile(const Camera& camera, int threads,
                            const std::function<void(const TileArea&, TileWorker&)>& work);

  const raycast::PictureTracer& rays_;
  const MaterialLibrary& materials_;
  const Scene scene_;
  const std::vector<Light> lights_;
  mutable RadianceCache store_;
};

}  // namespace ardee::render
