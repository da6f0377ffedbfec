// SPDX-License-Identifier: MIT
#include "ardee_sim/render/renderer.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <memory>

#include "ardee_sim/render/tile.h"

namespace ardee::render {
namespace {

constexpr int kTileSide_px = AdaptiveTile::kMostSide_px;

int tiles_along(int pixels) { return (pixels + kTileSide_px - 1) / kTileSide_px; }

}  // namespace

void Renderer::for_each_tile(const Camera& camera, int threads,
                             const std::function<void(const TileArea&, TileWorker&)>& work) {
  if (camera.width < 1 || camera.height < 1) {
    throw Error("found a picture without pixels, expected at least one");
  }
  const int columns = tiles_along(camera.width);
  const int count = columns * tiles_along(camera.height);
  // TBB has at most one worker a core unless told otherwise.
  std::unique_ptr<tbb::global_control> workers;
  if (threads > tbb::info::default_concurrency()) {
    workers = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(threads));
  }
  tbb::enumerable_thread_specific<TileWorker> of_threads;
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(0, count, [&](int tile) {
      const int left = tile % columns * kTileSide_px;
      const int upper = tile / columns * kTileSide_px;
      work({left, upper, std::min(kTileSide_px, camera.width - left),
            std::min(kTileSide_px, camera.height - upper)},
           of_threads.local());
    });
  });
}

Image Renderer::render(const Camera& camera, const RenderOptions& options,
                       const Progress& progress) const {
  if (options.samples < 1) throw Error("found no samples a pixel, expected at least one");
  Image image;
  image.width = camera.width;
  image.height = camera.height;
  image.samples8.resize(4 * static_cast<std::size_t>(std::max(image.width, 0)) *
                        static_cast<std::size_t>(std::max(image.height, 0)));
  const TileShading shading{rays_, materials_, scene_, sky_, lights_, camera, options, store_};
  const double pixels = static_cast<double>(camera.width) * camera.height;
  std::atomic<int> done_px{0};
  std::atomic<bool> stopped{false};
  for_each_tile(camera, options.threads, [&](const TileArea& area, TileWorker& worker) {
    if (stopped) return;
    shade_tile(shading, area, worker, image);
    const int done = done_px += area.width * area.height;
    if (progress && !progress(done / pixels)) stopped = true;
  });
  return stopped ? Image{} : image;
}

Frame Renderer::render_frame(const Camera& camera, const FrameParts& parts,
                             const RenderOptions& options) const {
  Frame frame;
  frame.width = camera.width;
  frame.height = camera.height;
  frame.threads = options.threads;
  const std::size_t count = static_cast<std::size_t>(std::max(frame.width, 0)) *
                            static_cast<std::size_t>(std::max(frame.height, 0));
  if (parts.light) frame.light.resize(count);
  if (parts.depth) frame.depth_m.resize(count);
  if (parts.ids) frame.entities.resize(count);
  if (parts.ids) frame.labels.resize(count);
  if (parts.visuals) frame.visuals.resize(count);
  if (parts.light && options.approximate) store_.open();
  RenderOptions once = options;
  once.samples = 1;
  const TileShading shading{rays_, materials_, scene_, sky_, lights_, camera, once, store_};
  for_each_tile(camera, options.threads, [&](const TileArea& area, TileWorker& worker) {
    render_frame_tile(shading, area, parts, worker, frame);
  });
  return frame;
}

}  // namespace ardee::render
