// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/core/error.h"

namespace ardee {

/// Refuses, before the mesh library sees it, a file that is missing, empty, huge, truncated, nested
/// so deeply that it would overflow the stack, or of a format that is not read. Returns its bytes.
/// Throws Error at `source`.
std::string check_mesh_file(const std::string& path, const Source& source);

}  // namespace ardee
