// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/physics/collision_shape.h"
#include "ardee_sim/physics/height_field_contacts.h"

namespace ardee::physics {

/// Finds at most `max_contacts` points where `a`, which moves, overlaps `b`.
void collide_shapes(const CollisionShape& a, const CollisionShape& b, int max_contacts,
                    ContactPoints& points);

}  // namespace ardee::physics
