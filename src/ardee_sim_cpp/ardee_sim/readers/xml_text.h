// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace ardee {

/// An XML text as UTF-8 without a declaration, processing instructions and a document type, lines
/// kept: what is left is read in one way by any XML library. Throws Error on an encoding that is
/// not known or does not fit, on a NUL, on declarations of entities and the like, and on elements
/// nested so deep that a library's stack would overflow. `name` stands for the text in messages.
std::string plain_xml(std::string text, const std::string& name);

}  // namespace ardee
