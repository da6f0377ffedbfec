// SPDX-License-Identifier: MIT
#pragma once

namespace ardee::raycast {

/// Bodies of the links that rays hit (thesis 4.3.3).
enum class SceneKind { kVisual, kCollision };

}  // namespace ardee::raycast
