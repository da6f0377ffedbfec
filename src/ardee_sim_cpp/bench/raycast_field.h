// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "ardee_sim/description/scenery.h"

namespace ardee::bench {

/// Returns a maize-like plant: a stalk and arched leaves, about 1,232 triangles, 1.9 m high, with a
/// cylinder for collisions.
std::shared_ptr<const Model> make_plant(std::uint64_t seed);

/// Returns `count` plants in rows 0.76 m apart, 8 a square metre, turned at random, from a few
/// descriptions.
std::vector<Placement> make_field(std::size_t count);

/// Returns the side of that field's square [m].
double field_side_m(std::size_t count);

}  // namespace ardee::bench
