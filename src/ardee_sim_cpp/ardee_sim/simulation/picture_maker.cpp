// SPDX-License-Identifier: MIT
#include "ardee_sim/simulation/picture_maker.h"

namespace ardee {

void PictureMaker::look_at_models() {
  looks_.clear();
  for (const auto& entity : entities_) {
    looks_.add(entity->robot->shared_model());
    const Model* last = nullptr;
    for (const Placement& placement : entity->placements) {
      if (placement.model.get() != last) looks_.add(placement.model);
      last = placement.model.get();
    }
  }
  renderer_.reset();
  current_ = true;
}

Frame PictureMaker::take(const Camera& camera, const FrameParts& parts) {
  if (parts.light && !current_) look_at_models();
  RenderOptions options;
  options.threads = threads_;
  options.quickly = true;
  const RayScene& rays = parts.light ? scenes_.for_pictures() : scenes_.now(SceneKind::kVisual);
  if (!renderer_ || &renderer_->rays() != &rays) {
    renderer_.emplace(rays, looks_, world_.scene, world_.lights);
  }
  return renderer_->shoot(camera, parts, options);
}

}  // namespace ardee
