// SPDX-License-Identifier: MIT
#include "ardee_sim/render/renderer.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <memory>

#include "ardee_sim/render/tile.h"

namespace ardee {
namespace {

constexpr int kTileSide_px = 16;

int tiles_along(int pixels) { return (pixels + kTileSide_px - 1) / kTileSide_px; }

}  // namespace

Image Renderer::render(const Camera& camera, const RenderOptions& options,
                       const Progress& progress) const {
  if (camera.width < 1 || camera.height < 1 || options.samples < 1) {
    throw Error("found a picture without pixels or samples, expected at least one of each");
  }
  Image image;
  image.width = camera.width;
  image.height = camera.height;
  image.samples8.resize(4 * static_cast<std::size_t>(image.width) *
                        static_cast<std::size_t>(image.height));
  const TileShading shading{rays_, looks_, scene_, lights_, camera, options};
  const int columns = tiles_along(camera.width);
  const int count = columns * tiles_along(camera.height);
  std::atomic<int> done{0};
  std::atomic<bool> stopped{false};
  // TBB has no more workers than cores unless it is told.
  std::unique_ptr<tbb::global_control> workers;
  if (options.threads > tbb::info::default_concurrency()) {
    workers = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(options.threads));
  }
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(0, count, [&](int tile) {
      if (stopped) return;
      const int left = tile % columns * kTileSide_px;
      const int upper = tile / columns * kTileSide_px;
      shade_tile(shading,
                 {left, upper, std::min(kTileSide_px, camera.width - left),
                  std::min(kTileSide_px, camera.height - upper)},
                 image);
      if (progress && !progress(static_cast<double>(++done) / count)) stopped = true;
    });
  });
  return stopped ? Image{} : image;
}

}  // namespace ardee
