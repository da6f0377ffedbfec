// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

namespace ardee {

/// Light up to this is shown as it is; what is brighter approaches white.
constexpr float kToneKnee = 0.8f;

/// From light to a pixel's brightness, both 0 to 1 (light may exceed it).
inline float tone(float light) {
  if (!(light > 0.0f)) return 0.0f;
  if (light <= kToneKnee) return light;
  const float room = 1.0f - kToneKnee;
  return kToneKnee + room * (1.0f - std::exp(-(light - kToneKnee) / room));
}

inline std::uint8_t to_byte(float brightness) {
  if (!(brightness > 0.0f)) return 0;
  return brightness < 1.0f ? static_cast<std::uint8_t>(255.0f * brightness + 0.5f) : 255;
}

}  // namespace ardee
