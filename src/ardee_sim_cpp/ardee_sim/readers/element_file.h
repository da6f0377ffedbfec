// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/description/element.h"

namespace ardee {

/// The root element of an XML file, for those who know what it holds. Throws FileError at `source`,
/// which names the file, or Error where the file is malformed.
Element read_element_file(const std::string& path, const Source& source);

}  // namespace ardee
