// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ardee_sim/core/rng.h"
#include "ardee_sim/render/frame.h"
#include "ardee_sim/render/white_balance.h"

namespace ardee::render {

/// Pixel format of a sensor's output. A Bayer pixel has one colour, by its place in a square of
/// four.
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

/// Parameters of the conversion from light to stored values.
struct ImageFormation {
  PixelFormat format = PixelFormat::kRgb8;
  std::optional<float> exposure;  // factor on the light; none: automatic
  WhiteBalance white_balance;     // acts after automatic exposure is metered
  double noise_mean = 0.0;        // as a share of full brightness
  double noise_std = 0.0;
};

/// Returns the factor of automatic exposure: it maps the median brightness to a middle grey, within
/// limits.
float automatic_exposure(const Frame& frame);

/// Returns the bytes of a picture, row by row; the noise of each value has its own counter. The
/// work is parallel; the bytes do not depend on that.
std::vector<std::uint8_t> form_image(const Frame& frame, const ImageFormation& how,
                                     const CounterRng& noise);

}  // namespace ardee::render
