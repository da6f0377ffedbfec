// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "ardee_sim/description/world.h"
#include "ardee_sim/image/image.h"
#include "ardee_sim/raycast/picture_tracer.h"
#include "ardee_sim/render/camera.h"
#include "ardee_sim/render/frame.h"
#include "ardee_sim/render/material_library.h"
#include "ardee_sim/render/radiance_cache.h"
#include "ardee_sim/render/tile.h"

namespace ardee::render {

/// Renders pictures of a scene: the same world and camera give the same bytes with any number of
/// threads.
class Renderer {
 public:
  /// Callback with the finished share, from several threads; it returns false to stop the work.
  using Progress = std::function<bool(double)>;

  /// Keeps references to `rays` (of the visual scene, prepared) and `materials`.
  Renderer(const raycast::PictureTracer& rays, const MaterialLibrary& materials, const Scene& scene,
           std::vector<Light> lights, const std::optional<Daylight>& day = std::nullopt)
      : rays_(rays),
        materials_(materials),
        scene_(scene),
        sky_(scene, day),
        lights_(std::move(lights)) {}

  const raycast::PictureTracer& rays() const { return rays_; }

  /// Renders eight bits of red, green, blue and opacity. Returns an empty image if `progress`
  /// stopped it.
  Image render(const Camera& camera, const RenderOptions& options,
               const Progress& progress = nullptr) const;

  /// Renders what a sensor behind the lens receives, with one ray through the middle of each pixel;
  /// ignores `options.samples`. While the camera moves, light is the mean over the exposure, all
  /// else is that of its middle; four rows at a time share their times. The scene stands still.
  Frame render_frame(const Camera& camera, const FrameParts& parts,
                     const RenderOptions& options) const;

 private:
  /// Calls `work(tile, worker)` for each tile of the picture, in parallel.
  static void for_each_tile(const Camera& camera, int tile_height_px, int threads,
                            const std::function<void(const TileArea&, TileWorker&)>& work);
  TileShading shading_by(const Camera& camera, const RenderOptions& options) const {
    return {rays_, materials_, scene_, sky_, lights_, camera, options, store_};
  }
  void render_moving(const Camera& camera, const FrameParts& parts, const RenderOptions& options,
                     Frame& frame) const;

  const raycast::PictureTracer& rays_;
  const MaterialLibrary& materials_;
  const Scene scene_;
  const Sky sky_;
  const std::vector<Light> lights_;
  mutable RadianceCache store_;
};

}  // namespace ardee::render
