// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace ardee {

/// A checked Collada document, as plain_xml gives it, with each <trifans>, which the mesh library
/// takes for a polygon, as <triangles>. `name` stands for the document in messages.
std::string fans_to_triangles(const std::string& collada, const std::string& name);

}  // namespace ardee
