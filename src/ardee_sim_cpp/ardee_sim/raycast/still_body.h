// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "ardee_sim/raycast/body.h"

namespace ardee {

/// A link of a model that could move, where it stood at some time.
struct StillBody {
  PlacedBody placed;
  std::shared_ptr<const std::vector<std::unique_ptr<Body>>> bodies;  // with that of `placed`
  std::shared_ptr<const std::uint64_t> moved_at;  // later than that time: it stands there no more
};

struct StillBodies {
  std::uint64_t time = 0;
  std::vector<StillBody> bodies;
};

}  // namespace ardee
