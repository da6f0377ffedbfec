// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace ardee {

/// Replaces each <trifans> of a checked Collada document, as plain_xml gives it, with <triangles>:
/// the mesh library takes a fan for a polygon. `name` denotes the document in messages.
std::string fans_to_triangles(const std::string& collada, const std::string& name);

}  // namespace ardee
