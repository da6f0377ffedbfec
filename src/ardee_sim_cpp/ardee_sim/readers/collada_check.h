// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/readers/xml.h"

namespace ardee {

/// Refuses a Collada document that the mesh library would hang on or crash over: words where
/// numbers belong, dangling references, accessors beyond their array, nodes that contain
/// themselves. Throws Error with file, line and element.
void check_collada(const Node& root);

}  // namespace ardee
