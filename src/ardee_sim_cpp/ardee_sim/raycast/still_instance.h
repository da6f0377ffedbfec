// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "ardee_sim/raycast/traceable.h"

namespace ardee::raycast {

/// Link of a movable model where it stood at some time.
struct StillInstance {
  TraceableInstance placed;
  std::shared_ptr<const TraceableBodies> bodies;  // owns that of `placed`
  std::shared_ptr<const std::uint64_t> moved_at;  // later than that time: it has left
};

struct StillInstances {
  std::uint64_t time = 0;
  std::vector<StillInstance> bodies;
};

}  // namespace ardee::raycast
