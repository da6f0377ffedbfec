// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/model.h"

namespace ardee {

/// Checks the consistency of a model: names are unique and not empty, joints connect links that
/// exist, masses and inertias are possible. Throws Error at the link or joint concerned; an
/// impossible inertia is a warning. Static and kinematic links may have any inertia, URDF's
/// massless links need none.
void validate_model(const Model& model, Log& log);

/// Message text with the name that was found and the links that exist.
std::string unknown_link(const std::string& name, const Model& model);

}  // namespace ardee
