// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace ardee {

/// Converts an XML text to UTF-8 without declaration, processing instructions and document type,
/// lines kept, so that all XML libraries read it in one way. Throws Error on an encoding that is
/// unknown or does not fit, on a NUL, on declarations of entities and the like, and on elements
/// nested so deep that a library's stack would overflow. `name` denotes the text in messages.
std::string plain_xml(std::string text, const std::string& name);

}  // namespace ardee
