// SPDX-License-Identifier: MIT
#include "ardee_sim/simulation/lone_pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "ardee_sim/raycast/ray_scene.h"
#include "ardee_sim/render/renderer.h"

namespace ardee {
namespace {

/// Width of the border about a part's pixels: much more than the error of its place, and so that it
/// holds the way of a camera in motion, which is not quite straight.
constexpr double kMargin_px = 0.01, kMovingMargin_px = 8.0;
/// Depth of the plane at which a part is cut: only what lies in front has a place in a picture.
constexpr double kLeastDepth_m = 1e-6;
/// Share of its distance by which an eye may seem to lie on the wrong side of a triangle.
constexpr double kPlaneError = 1e-6;

/// Whether the scenery covers a pixel; rays tell where it may.
enum Cover : std::uint8_t { kFree = 0, kMaybe = 1, kCovered = 2 };

/// Covers of a picture's pixels, row by row.
struct CoverMap {
  explicit CoverMap(const render::Camera& camera)
      : width(camera.width),
        height(camera.height),
        pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), kFree) {}

  /// Raises the cover of each pixel of a rectangle to at least `cover_at(x, y)` of its middle.
  template <typename CoverAt>
  void raise(Eigen::Array2d lower, Eigen::Array2d upper, CoverAt cover_at) {
    const Eigen::Array2d size(width, height);
    const Eigen::Array2i from = (lower - 0.5).ceil().max(0.0).min(size).cast<int>();
    const Eigen::Array2i end = (upper - 0.5).floor().max(-1.0).min(size - 1.0).cast<int>() + 1;
    for (int y = from.y(); y < end.y(); ++y) {
      std::uint8_t* row = pixels.data() + static_cast<std::ptrdiff_t>(y) * width;
      for (int x = from.x(); x < end.x(); ++x) {
        row[x] = std::max(row[x], static_cast<std::uint8_t>(cover_at(x + 0.5, y + 0.5)));
      }
    }
  }

  int width, height;
  std::vector<std::uint8_t> pixels;
};

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

/// Marks the pixels that a part of the scenery may cover in a camera that is at each of `moments`
/// once.
void mark_possible(const std::vector<Eigen::Vector3d>& corners,
                   const std::vector<render::Camera>& moments, CoverMap& map) {
  Eigen::Array2d lower = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array2d upper = -lower;
  for (const render::Camera& camera : moments) {
    for (const Eigen::Vector3d& point : cut_in_front(corners, camera.X_WC)) {
      if (const auto pixel = camera.project(point)) {
        lower = lower.min(pixel->array());
        upper = upper.max(pixel->array());
      }
    }
  }
  const double margin_px = moments.size() > 1 ? kMovingMargin_px : kMargin_px;
  map.raise(lower - margin_px, upper + margin_px, [](double, double) { return kMaybe; });
}

/// Returns whether all points have a depth at which the camera sees.
bool in_reach(const std::vector<Eigen::Vector3d>& points_W, const render::Camera& camera) {
  const Eigen::Vector3d ahead_W = camera.X_WC.q * Eigen::Vector3d::UnitX();
  return std::all_of(points_W.begin(), points_W.end(), [&](const Eigen::Vector3d& point_W) {
    const double depth_m = ahead_W.dot(point_W - camera.X_WC.p);
    return depth_m > camera.near_m + kLeastDepth_m && depth_m < camera.far_m - kLeastDepth_m;
  });
}

/// Marks the pixels of an opaque triangle within the reach of a camera at rest: all but those that
/// its edges nearly meet are covered for certain.
void mark_triangle(const raycast::SceneryPart& part, const render::Camera& camera, CoverMap& map) {
  const std::vector<Eigen::Vector3d>& corners = part.corners_W;
  const Eigen::Vector3d normal_W = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const Eigen::Vector3d way_W = corners[0] - camera.X_WC.p;
  const double away = normal_W.dot(way_W), error = kPlaneError * normal_W.norm() * way_W.norm();
  if (!part.is_two_sided && away > error) return;  // seen from behind
  const bool is_certain = part.is_two_sided ? std::abs(away) > error : away < -error;
  std::array<Eigen::Array2d, 3> at_px;
  for (std::size_t k = 0; k < 3; ++k) at_px[k] = camera.project(corners[k])->array();
  const Eigen::Array2d lower = at_px[0].min(at_px[1]).min(at_px[2]) - kMargin_px;
  const Eigen::Array2d upper = at_px[0].max(at_px[1]).max(at_px[2]) + kMargin_px;
  // Lines through the edges: distances in pixels, positive inside.
  Eigen::Matrix3d lines;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Array2d& from = at_px[k];
    const Eigen::Array2d way = at_px[(k + 1) % 3] - from;
    const double length_px = std::max(std::hypot(way.x(), way.y()), 1e-12);
    lines.row(static_cast<Eigen::Index>(k)) =
        Eigen::RowVector3d(-way.y(), way.x(), way.y() * from.x() - way.x() * from.y()) / length_px;
  }
  if (lines.row(0) * at_px[2].matrix().homogeneous() < 0.0) lines = -lines;
  map.raise(lower, upper, [&](double x, double y) {
    const double inside_px = (lines * Eigen::Vector3d(x, y, 1.0)).minCoeff();
    if (inside_px < -kMargin_px) return kFree;
    return is_certain && inside_px > kMargin_px ? kCovered : kMaybe;
  });
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

/// Returns which pixels the scenery covers, as far as this can be told without rays.
CoverMap cover(const raycast::RayScene& rays, const render::Camera& camera) {
  CoverMap map(camera);
  if (!camera.is_straight()) {
    std::fill(map.pixels.begin(), map.pixels.end(), kMaybe);
    return map;
  }
  const std::vector<render::Camera> moments = ends_of(camera);
  rays.for_each_part([&](const raycast::SceneryPart& part) {
    if (part.is_opaque && moments.size() == 1 && in_reach(part.corners_W, camera)) {
      mark_triangle(part, camera, map);
    } else {
      mark_possible(part.corners_W, moments, map);
    }
  });
  return map;
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
  const CoverMap map = cover(rays, camera);
  how.wanted = &map.pixels;
  const render::Frame frame = renderer.render_frame(camera, parts, how);
  const auto free = std::count(frame.entities.begin(), frame.entities.end(), raycast::kNoEntity);
  const auto covered = std::count(map.pixels.begin(), map.pixels.end(), kCovered);
  return frame.entities.size() - static_cast<std::size_t>(free) + static_cast<std::size_t>(covered);
}

}  // namespace ardee
