// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/core/error.h"
#include "ardee_sim/core/log.h"

namespace ardee {

/// Rewrites parts of a checked mesh file that are valid or harmless, but that the mesh library does
/// not read: numbers of an OBJ that begin with a point, fans of a DAE. Returns the bytes. Bytes
/// after the last triangle of a binary STL are cut off, with a warning.
std::string repair_mesh_file(std::string bytes, const std::string& path, const Source& source,
                             Log& log);

}  // namespace ardee
