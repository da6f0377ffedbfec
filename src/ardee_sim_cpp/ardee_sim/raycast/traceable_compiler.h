// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/model.h"
#include "ardee_sim/raycast/scene_kind.h"
#include "ardee_sim/raycast/traceable.h"

namespace ardee::raycast {

/// Returns all links of a static model as one body in the model's frame, or each link as a body in
/// its own frame. Scenes of this process share the bodies of a description as long as one uses
/// them. Warns of textures that cannot be read. Throws Error if a shape is invalid (a submesh that
/// does not exist, a size that is not finite).
std::shared_ptr<const Traceable> compile_model(const std::shared_ptr<const Model>& model,
                                               SceneKind kind, Log& log);
std::shared_ptr<const TraceableBodies> compile_links(const std::shared_ptr<const Model>& model,
                                                     SceneKind kind, Log& log);

}  // namespace ardee::raycast
