// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace ardee {

/// A checked Collada document with each <trifans>, which the mesh library takes for a polygon, as
/// <triangles>.
std::string fans_to_triangles(const std::string& collada);

}  // namespace ardee
