// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/readers/xml.h"

namespace ardee {

/// Refuses a Collada document that the mesh library would hang on or crash over: words where
/// numbers belong, references to nothing, accessors beyond their array, nodes that hold themselves.
/// Throws Error with file, line and element.
void check_collada(const Node& root);

}  // namespace ardee
