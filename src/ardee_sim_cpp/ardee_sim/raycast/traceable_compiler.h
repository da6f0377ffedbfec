// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "ardee_sim/description/model.h"
#include "ardee_sim/raycast/scene_kind.h"
#include "ardee_sim/raycast/traceable.h"

namespace ardee::raycast {

/// Compiles all links of a static model to one body in the model's frame, or one link alone in its
/// own frame. Throws Error if a shape is invalid (a submesh that does not exist, a size that is not
/// finite).
std::unique_ptr<Traceable> compile_model(const EmbreeDevice& device, AlphaMasks& masks,
                                         const Model& model, SceneKind kind);
std::unique_ptr<Traceable> compile_link(const EmbreeDevice& device, AlphaMasks& masks,
                                        const Model& model, std::uint32_t link, SceneKind kind);

}  // namespace ardee::raycast
