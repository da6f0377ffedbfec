// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace ardee::raycast {

struct RayOptions {
  int threads = 0;  // 0: all cores
  /// Memory of all local scenes together.
  std::size_t local_scene_budget_bytes = 512u << 20;
  /// Least radius of a local scene about its sensor, if the budget allows (measured: README.md).
  double local_scene_radius_m = 6.0;
  /// False: rays are traced through the placements alone, with the same hits.
  bool local_scenes = true;
};

}  // namespace ardee::raycast
