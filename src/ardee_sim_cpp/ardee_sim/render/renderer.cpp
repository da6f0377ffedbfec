// SPDX-License-Identifier: MIT
#include "ardee_sim/render/renderer.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "ardee_sim/render/tile.h"

namespace ardee::render {
namespace {

constexpr int kTileSide_px = AdaptiveTile::kMostSide_px;

/// Rows of a rolling shutter that share their times.
constexpr int kRowsAtOnce = 4;
/// Greatest number of moments of an exposure.
constexpr int kMostMoments = 64;

int tiles_along(int pixels, int side_px) { return (pixels + side_px - 1) / side_px; }

/// Tiles of the picture of a camera in motion, and the ways of what they show.
class MovingTiles {
 public:
  explicit MovingTiles(const Camera& camera)
      : camera_(camera),
        height_px_(camera.motion.readout_time_s > 0.0 ? kRowsAtOnce : kTileSide_px),
        columns_(tiles_along(camera.width, kTileSide_px)),
        paths_px_(static_cast<std::size_t>(columns_ * tiles_along(camera.height, height_px_))) {}

  int height_px() const { return height_px_; }

  /// Returns the pose at a share of the exposure of a tile's middle row.
  Pose pose_at(const TileArea& tile, double share) const {
    const double middle_row = tile.upper + 0.5 * (tile.height - 1);
    return camera_.pose_at(camera_.motion.readout_time_s * middle_row / camera_.height +
                           share * camera_.motion.exposure_time_s);
  }

  /// Tells that a tile shows something so near in the middle of its exposure.
  void set_nearest(const TileArea& tile, double nearest_m) {
    const Twist& twist_W = camera_.motion.twist_W;
    const double speed = twist_W.linear.norm() / nearest_m + twist_W.angular.norm();
    paths_px_[static_cast<std::size_t>(row(tile) * columns_ + column(tile))] =
        camera_.focal_length_px() * camera_.motion.exposure_time_s * speed;
  }

  /// Returns the number of moments of which none moves what comes through a tile by more than about
  /// a pixel.
  int moments(const TileArea& tile) const {
    double longest_px = 0.0;
    for (std::size_t k = 0; k < paths_px_.size(); ++k) {
      const int other = static_cast<int>(k);
      const int apart_px = std::max((std::abs(other % columns_ - column(tile)) - 1) * kTileSide_px,
                                    (std::abs(other / columns_ - row(tile)) - 1) * height_px_);
      if (paths_px_[k] > 2.0 * apart_px) longest_px = std::max(longest_px, paths_px_[k]);
    }
    return static_cast<int>(std::clamp(std::ceil(longest_px), 1.0, double{kMostMoments}));
  }

 private:
  static int column(const TileArea& tile) { return tile.left / kTileSide_px; }
  int row(const TileArea& tile) const { return tile.upper / height_px_; }

  const Camera& camera_;
  const int height_px_;
  const int columns_;
  std::vector<double> paths_px_;
};

}  // namespace

void Renderer::for_each_tile(const Camera& camera, int tile_height_px, int threads,
                             const std::function<void(const TileArea&, TileWorker&)>& work) {
  if (camera.width < 1 || camera.height < 1) {
    throw Error("found a picture without pixels, expected at least one");
  }
  const int columns = tiles_along(camera.width, kTileSide_px);
  const int count = columns * tiles_along(camera.height, tile_height_px);
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
      const int upper = tile / columns * tile_height_px;
      work({left, upper, std::min(kTileSide_px, camera.width - left),
            std::min(tile_height_px, camera.height - upper)},
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
  const TileShading shading = shading_by(camera, options);
  const double pixels = static_cast<double>(camera.width) * camera.height;
  std::atomic<int> done_px{0};
  std::atomic<bool> stopped{false};
  const auto shade = [&](const TileArea& area, TileWorker& worker) {
    if (stopped) return;
    shade_tile(shading, area, worker, image);
    const int done = done_px += area.width * area.height;
    if (progress && !progress(done / pixels)) stopped = true;
  };
  for_each_tile(camera, kTileSide_px, options.threads, shade);
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
  if (parts.ids) frame.entities.resize(count, raycast::kNoEntity);
  if (parts.ids) frame.labels.resize(count);
  if (parts.visuals) frame.visuals.resize(count);
  if (parts.light && options.approximate) store_.open();
  RenderOptions once = options;
  once.samples = 1;
  if (camera.motion.is_seen()) {
    render_moving(camera, parts, once, frame);
    return frame;
  }
  const TileShading shading = shading_by(camera, once);
  const auto shade = [&](const TileArea& tile, TileWorker& worker) {
    render_frame_tile(shading, tile, parts, worker, frame);
  };
  for_each_tile(camera, kTileSide_px, options.threads, shade);
  return frame;
}

void Renderer::render_moving(const Camera& camera, const FrameParts& parts,
                             const RenderOptions& options, Frame& frame) const {
  MovingTiles tiles(camera);
  const auto render_at = [&](const TileArea& tile, double share, const FrameParts& which,
                             TileWorker& worker) {
    Camera then = camera;
    then.X_WC = tiles.pose_at(tile, share);
    render_frame_tile(shading_by(then, options), tile, which, worker, frame);
  };
  const auto take_middle = [&](const TileArea& tile, TileWorker& worker) {
    render_at(tile, 0.5, parts, worker);
    if (!parts.light) return;
    tiles.set_nearest(
        tile, options.approximate ? static_cast<double>(worker.adaptive.nearest_m()) : 1e-9);
  };
  for_each_tile(camera, tiles.height_px(), options.threads, take_middle);
  if (!parts.light || camera.motion.exposure_time_s == 0.0) return;
  const auto take_mean = [&](const TileArea& tile, TileWorker& worker) {
    const int count = tiles.moments(tile);
    if (count == 1) return;
    FrameParts light;
    light.light = true;
    std::vector<Eigen::Vector3f> sums(static_cast<std::size_t>(tile.width * tile.height),
                                      Eigen::Vector3f::Zero());
    const auto for_each_pixel = [&](const auto& act) {
      for (std::size_t k = 0; k < sums.size(); ++k) {
        const int pixel = static_cast<int>(k);
        act(sums[k], frame.light[frame.index(tile.left + pixel % tile.width,
                                             tile.upper + pixel / tile.width)]);
      }
    };
    for (int i = 0; i < count; ++i) {
      render_at(tile, (i + 0.5) / count, light, worker);
      for_each_pixel([](auto& sum, const auto& at) { sum += at; });
    }
    for_each_pixel([&](const auto& sum, auto& at) { at = sum / static_cast<float>(count); });
  };
  for_each_tile(camera, tiles.height_px(), options.threads, take_mean);
}

}  // namespace ardee::render
