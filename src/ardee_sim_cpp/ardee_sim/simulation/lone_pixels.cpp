// SPDX-License-Identifier: MIT
#include "ardee_sim/simulation/lone_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "ardee_sim/raycast/ray_scene.h"
#include "ardee_sim/render/renderer.h"

namespace ardee {
namespace {

/// Width of the border about a part's pixels: much more than the error of its place, and so that it
/// holds the way of a camera in motion, which is not quite straight.
constexpr double kMargin_px = 0.1, kMovingMargin_px = 8.0;
/// Depth of the plane at which a part is cut: only what lies in front has a place in a picture.
constexpr double kLeastDepth_m = 1e-6;

/// Returns points of which the convex hull is that of `corners`, as far as it lies in front of the
/// camera.
std::vector<Eigen::Vector3d> cut_in_front(const std::vector<Eigen::Vector3d>& corners,
                                          const Pose& X_WC) {
  const Eigen::Vector3d ahead_W = X_WC.q * Eigen::Vector3d::UnitX();
  const auto depth_m = [&](const Eigen::Vector3d& point_W) {
    return ahead_W.dot(point_W - X_WC.p) - kLeastDepth_m;
  };
  std::vector<Eigen::Vector3d> found;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double here_m = depth_m(corners[i]);
    if (here_m >= 0.0) found.push_back(corners[i]);
    for (std::size_t k = 0; k < i; ++k) {
      const double there_m = depth_m(corners[k]);
      if ((here_m < 0.0) == (there_m < 0.0)) continue;
      const double share = here_m / (here_m - there_m);
      found.push_back(corners[i] + share * (corners[k] - corners[i]));
    }
  }
  return found;
}

/// Marks the pixels that a part of the scenery with these corners may cover in a camera that is at
/// each of `moments` once.
void mark(const std::vector<Eigen::Vector3d>& corners, const std::vector<render::Camera>& moments,
          std::vector<std::uint8_t>& marked) {
  const Eigen::Array2d size(moments.front().width, moments.front().height);
  Eigen::Array2d lower = size, upper = Eigen::Array2d::Zero();
  for (const render::Camera& camera : moments) {
    for (const Eigen::Vector3d& point : cut_in_front(corners, camera.X_WC)) {
      if (const auto pixel = camera.project(point)) {
        lower = lower.min(pixel->array());
        upper = upper.max(pixel->array());
      }
    }
  }
  const double margin_px = 0.5 + (moments.size() > 1 ? kMovingMargin_px : kMargin_px);
  const Eigen::Array2i from = (lower - margin_px).ceil().max(0.0).min(size).cast<int>();
  const Eigen::Array2i end = (upper + margin_px).floor().max(0.0).min(size).cast<int>();
  for (int y = from.y(); y < end.y(); ++y) {
    const auto row = marked.begin() + y * moments.front().width;
    std::fill(row + from.x(), row + std::max(from.x(), end.x()), std::uint8_t{1});
  }
}

/// Returns the camera as it is when the first row's exposure begins, and, if it moves, when the
/// last one's ends.
std::vector<render::Camera> ends_of(const render::Camera& camera) {
  std::vector<render::Camera> moments{camera};
  moments.front().X_WC = camera.pose_at(0.0);
  if (camera.motion.is_seen()) {
    const double end_s = camera.motion.exposure_time_s + camera.motion.readout_time_s;
    moments.push_back(camera);
    moments.back().X_WC = camera.pose_at(end_s);
  }
  return moments;
}

/// Returns for each pixel, row by row, 1 if the scenery may cover it, else 0.
std::vector<std::uint8_t> marked_pixels(const raycast::RayScene& rays,
                                        const render::Camera& camera) {
  const std::size_t count =
      static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  std::vector<std::uint8_t> marked(count, camera.is_straight() ? 0 : 1);
  if (camera.is_straight()) {
    const std::vector<render::Camera> moments = ends_of(camera);
    rays.for_each_part(
        [&](const std::vector<Eigen::Vector3d>& corners) { mark(corners, moments, marked); });
  }
  return marked;
}

}  // namespace

std::size_t lone_pixels(const Placement& placement, const render::Camera& camera,
                        const raycast::RayOptions& options, Log log) {
  raycast::RayOptions alone = options;
  alone.local_scenes = false;
  raycast::RayScene rays(raycast::SceneKind::kVisual, alone, log);
  rays.add_scenery(0, {placement});
  rays.prepare({camera.X_WC.p});
  const render::MaterialLibrary no_materials(log);
  const render::Renderer renderer(rays.pictures(), no_materials, {}, {});
  render::FrameParts parts;
  parts.ids = true;
  render::RenderOptions how;
  how.threads = options.threads;
  const std::vector<std::uint8_t> marked = marked_pixels(rays, camera);
  how.wanted = &marked;
  const render::Frame frame = renderer.render_frame(camera, parts, how);
  return frame.entities.size() -
         static_cast<std::size_t>(
             std::count(frame.entities.begin(), frame.entities.end(), raycast::kNoEntity));
}

}  // namespace ardee
