// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/core/error.h"
#include "ardee_sim/core/log.h"

namespace ardee {

/// The bytes of a checked mesh file with what is valid in it, or does no harm, written as the mesh
/// library reads it: numbers of an OBJ that begin with a point, fans of a DAE. Bytes after the last
/// triangle of a binary STL are cut off, with a warning.
std::string repair_mesh_file(std::string bytes, const std::string& path, const Source& source,
                             Log& log);

}  // namespace ardee
