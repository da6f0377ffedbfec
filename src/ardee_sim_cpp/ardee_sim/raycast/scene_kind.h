// SPDX-License-Identifier: MIT
#pragma once

namespace ardee::raycast {

/// Which bodies of the links rays meet (thesis 4.3.3).
enum class SceneKind { kVisual, kCollision };

}  // namespace ardee::raycast
