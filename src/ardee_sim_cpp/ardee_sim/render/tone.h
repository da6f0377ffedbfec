// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace ardee::render {

/// Greatest light that is shown unchanged; brighter light approaches white.
constexpr float kToneKnee = 0.8f;

/// Converts light to a pixel's brightness, both 0 to 1 (light may exceed 1). Beyond the knee it is
/// nearly 1 - exp(-x), but computed by the sixteenth power of 1 + x / 16, which vectorizes.
inline float tone(float light) {
  constexpr float kRoom = 1.0f - kToneKnee;
  const float shown = light > 0.0f ? light : 0.0f;
  const float above = shown > kToneKnee ? shown - kToneKnee : 0.0f;
  float power = 1.0f + above * (1.0f / (16.0f * kRoom));
  for (int k = 0; k < 4; ++k) power *= power;
  return (shown < kToneKnee ? shown : kToneKnee) + kRoom * (1.0f - 1.0f / power);
}

inline std::uint8_t to_byte(float brightness) {
  if (!(brightness > 0.0f)) return 0;
  return brightness < 1.0f ? static_cast<std::uint8_t>(255.0f * brightness + 0.5f) : 255;
}

}  // namespace ardee::render
