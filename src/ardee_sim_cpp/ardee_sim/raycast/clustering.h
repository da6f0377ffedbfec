// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "ardee_sim/raycast/bounds.h"

namespace ardee::raycast {

/// Divides boxes into groups of at most `group_size` near each other. `order` lists the boxes group
/// by group. Returns the start of each group in it, and its end.
std::vector<std::uint32_t> group_boxes(const std::vector<Bounds>& boxes, std::uint32_t group_size,
                                       std::vector<std::uint32_t>& order);

}  // namespace ardee::raycast
