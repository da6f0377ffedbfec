// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/log.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// Finds what is wrong with a URDF and says where; the library that reads it afterwards knows no
/// lines. `root` is the <robot>. Checked are numbers, geometries, joint types, limits, names, and
/// that links and joints make one tree.
void check_urdf(const Node& root, Log& log);

}  // namespace ardee
