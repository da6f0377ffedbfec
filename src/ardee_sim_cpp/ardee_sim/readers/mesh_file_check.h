// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/core/error.h"

namespace ardee {

/// Refuses, before the mesh library sees it, a file that is missing, empty, huge, truncated, nested
/// so deeply that it would overflow the stack, or of an unsupported format. Returns its bytes.
/// Throws Error at `source`.
std::string check_mesh_file(const std::string& path, const Source& source);

/// Extension of a path in small letters: ".stl".
std::string mesh_file_extension(const std::string& path);

/// Length of a checked STL in bytes: up to the end of the triangles of a binary file, all bytes of
/// an ASCII file.
std::size_t binary_stl_size(const std::string& bytes);

}  // namespace ardee
