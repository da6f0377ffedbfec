// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/core/error.h"

namespace ardee {

/// Refuses, before the mesh library sees it, a file that is missing, empty, huge, truncated, nested
/// so deeply that it would overflow the stack, or of a format that is not read. Returns its bytes.
/// Throws Error at `source`.
std::string check_mesh_file(const std::string& path, const Source& source);

/// ".stl", in small letters.
std::string mesh_file_extension(const std::string& path);

/// Of a checked STL: where the triangles of a binary one end, or all bytes of an ASCII one.
std::size_t binary_stl_size(const std::string& bytes);

}  // namespace ardee
