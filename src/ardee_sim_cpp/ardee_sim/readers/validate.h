// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/model.h"

namespace ardee {

/// Checks what holds between the parts of a model: names that are unique and not empty, joints
/// between links that exist, masses and inertias that a body can have. Throws Error at the link or
/// joint concerned; an inertia that no body has is a warning. What no force moves may have any
/// inertia, URDF's massless links need none.
void validate_model(const Model& model, Log& log);

/// For messages: what was found and which links there are.
std::string unknown_link(const std::string& name, const Model& model);

}  // namespace ardee
