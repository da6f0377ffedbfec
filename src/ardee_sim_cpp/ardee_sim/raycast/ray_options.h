// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace ardee::raycast {

struct RayOptions {
  int threads = 0;  // 0: all cores
  /// Of all local scenes together.
  std::size_t local_scene_budget_bytes = 512u << 20;
  /// A local scene reaches at least this far about its sensor, if the budget allows (measured:
  /// README.md).
  double local_scene_radius_m = 6.0;
  /// False: rays go through the placements alone. What they return is the same.
  bool local_scenes = true;
};

}  // namespace ardee::raycast
