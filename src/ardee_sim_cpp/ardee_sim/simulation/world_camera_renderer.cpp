// SPDX-License-Identifier: MIT
#include "ardee_sim/simulation/world_camera_renderer.h"

namespace ardee {

void WorldCameraRenderer::load_materials() {
  materials_.clear();
  for (const auto& entity : entities_) {
    materials_.add(entity->robot->shared_model());
    const Model* last = nullptr;
    for (const Placement& placement : entity->placements) {
      if (placement.model.get() != last) materials_.add(placement.model);
      last = placement.model.get();
    }
  }
  renderer_.reset();
  current_ = true;
}

render::Frame WorldCameraRenderer::take(const render::Camera& camera,
                                        const render::FrameParts& parts) {
  if (parts.light && !current_) load_materials();
  render::RenderOptions options;
  options.threads = threads_;
  options.approximate = true;
  const raycast::RayScene& scene =
      parts.light ? scenes_.for_pictures() : scenes_.now(raycast::SceneKind::kVisual);
  const raycast::PictureTracer& rays = scene.pictures();
  if (!renderer_ || &renderer_->rays() != &rays) {
    renderer_.emplace(rays, materials_, scene_, lights_, daylight_);
  }
  return renderer_->render_frame(camera, parts, options);
}

}  // namespace ardee
