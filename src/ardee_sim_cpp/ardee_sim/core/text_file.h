// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "ardee_sim/core/error.h"

namespace ardee {

/// Reads the bytes of a file. Throws Error at `source` if it is not a readable regular file or
/// larger than `max_bytes`.
std::string read_text_file(const std::string& path, const Source& source, std::size_t max_bytes);

/// The folder of a path; empty for a bare name.
std::string folder_of(const std::string& path);

}  // namespace ardee
