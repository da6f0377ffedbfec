// SPDX-License-Identifier: MIT
#include "ardee_sim/simulation/lone_pixels.h"

#include <algorithm>
#include <cmath>

#include "ardee_sim/raycast/ray_scene.h"
#include "ardee_sim/render/renderer.h"

namespace ardee {
namespace {

constexpr double kMargin_px = 8.0;  // a camera's path is not quite straight

/// Returns an area that holds all pixels of these boxes.
render::TileArea area_of(const std::vector<raycast::Bounds>& boxes, const render::Camera& camera) {
  const render::TileArea whole{0, 0, camera.width, camera.height};
  if (!camera.is_straight()) return whole;
  Eigen::Array2d lower = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array2d upper = -lower;
  const double open_s = camera.motion.exposure_time_s + camera.motion.readout_time_s;
  for (const double time_s : {0.0, open_s}) {
    render::Camera then = camera;
    then.X_WC = camera.pose_at(time_s);
    for (const raycast::Bounds& box : boxes) {
      for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d share(corner & 1, corner >> 1 & 1, corner >> 2);
        const auto pixel = then.project(box.lower + share.cwiseProduct(box.upper - box.lower));
        if (!pixel) return whole;
        lower = lower.min(pixel->array());
        upper = upper.max(pixel->array());
      }
    }
  }
  const Eigen::Array2d size(camera.width, camera.height);
  lower = (lower - kMargin_px).floor().max(0.0).min(size);
  upper = (upper + kMargin_px).ceil().max(0.0).min(size);
  const Eigen::Array2i from = lower.cast<int>(), extent = (upper - lower).max(0.0).cast<int>();
  return {from.x(), from.y(), extent.x(), extent.y()};
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
  const render::Frame frame =
      renderer.render_frame(camera, parts, how, area_of(rays.scenery_boxes(), camera));
  return frame.entities.size() -
         static_cast<std::size_t>(
             std::count(frame.entities.begin(), frame.entities.end(), raycast::kNoEntity));
}

}  // namespace ardee
