// SPDX-License-Identifier: MIT
#pragma once

#include <urdf_model/types.h>
#include <urdf_world/types.h>

#include <string>

#include "ardee_sim/core/error.h"
#include "ardee_sim/core/log.h"

namespace ardee {

/// Parses by urdfdom. What it says on its way is an Error at `source` if it fails, and warnings in
/// the log if not.
urdf::ModelInterfaceSharedPtr parse_with_urdfdom(const std::string& text, const Source& source,
                                                 Log& log);

}  // namespace ardee
