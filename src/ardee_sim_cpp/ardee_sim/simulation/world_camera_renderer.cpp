// SPDX-License-Identifier: MIT
#include "ardee_sim/simulation/world_camera_renderer.h"

namespace ardee {

void WorldCameraRenderer::look_at_models() {
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
  if (parts.light && !current_) look_at_models();
  render::RenderOptions options;
  options.threads = threads_;
  options.approximate = true;
  const raycast::RayScene& rays =
      parts.light ? scenes_.for_pictures() : scenes_.now(raycast::SceneKind::kVisual);
  if (!renderer_ || &renderer_->rays() != &rays) {
    renderer_.emplace(rays, materials_, world_.scene, world_.lights);
  }
  return renderer_->render_frame(camera, parts, options);
}

}  // namespace ardee
