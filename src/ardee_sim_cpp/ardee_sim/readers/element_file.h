// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/description/element.h"

namespace ardee {

/// Reads the root element of an XML file, for a caller that knows its format. Throws FileError at
/// `source`, which names the file, or Error if the file is malformed.
Element read_element_file(const std::string& path, const Source& source);

}  // namespace ardee
