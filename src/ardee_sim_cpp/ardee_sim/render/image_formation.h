// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ardee_sim/core/rng.h"
#include "ardee_sim/render/frame.h"

namespace ardee::render {

/// How a sensor's pixels leave it. A Bayer pixel has one colour, by its place in a square of four.
enum class PixelFormat {
  kRgb8,
  kBgr8,
  kMono8,
  kMono16,
  kBayerRggb8,
  kBayerBggr8,
  kBayerGbrg8,
  kBayerGrbg8
};

int bytes_per_pixel(PixelFormat format);

/// From light to numbers.
struct ImageFormation {
  PixelFormat format = PixelFormat::kRgb8;
  std::optional<float> exposure;  // factor on the light; none: automatic
  double noise_mean = 0.0;        // of brightness, of which 1 is full
  double noise_std = 0.0;
};

/// The factor of automatic exposure: the median brightness comes to a middle grey, within limits.
float automatic_exposure(const Frame& frame);

/// The bytes of a picture, row by row; the noise of a value uses the counter of its own. The work
/// is parallel, the bytes do not depend on it.
std::vector<std::uint8_t> form_image(const Frame& frame, const ImageFormation& how,
                                     const CounterRng& noise);

}  // namespace ardee::render
