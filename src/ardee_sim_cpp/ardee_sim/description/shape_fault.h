// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "ardee_sim/description/geometry.h"

namespace ardee {

/// A number or file of a shape that has no meaning.
struct ShapeFault {
  const char* field;     // as SDF and URDF name it: "radius"
  const char* expected;  // "a positive number"

  /// "found an invalid radius, expected a positive number".
  std::string message() const;
};

/// The first fault of a shape; none if the physics and the rays can use it. Readers report it at
/// the line of the field; physics and rays refuse a description that no reader has checked.
std::optional<ShapeFault> find_fault(const Geometry& geometry);

}  // namespace ardee
