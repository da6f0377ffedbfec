// SPDX-License-Identifier: MIT
#include "ardee_sim/render/texture.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace ardee::render {
namespace {

/// Share of the way between two copies in which they are mixed.
constexpr float kMixed = 0.25f;

// Vectors of four bytes in the syntax of GCC and Clang.
using Bytes = std::uint8_t __attribute__((vector_size(4)));
using Floats = float __attribute__((vector_size(16)));

/// Coordinate beyond which a place on a texture has no digits left.
constexpr double kFarthest = 1e9;

/// Returns x minus the greatest integer not above it.
double fraction(double x) {
  const double rest = x - static_cast<double>(static_cast<std::int64_t>(x));
  return rest < 0.0 ? rest + 1.0 : rest;
}

/// Returns a logarithm that is linear between powers of two: the bits of a positive float, read as
/// a number.
float rough_log2(float x) {
  std::int32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return static_cast<float>(bits - 0x3F800000) * 0x1p-23f;
}

Floats floats_of(const std::array<std::uint8_t, 4>& texel) {
  Bytes bytes;
  std::memcpy(&bytes, texel.data(), sizeof bytes);
  return __builtin_convertvector(bytes, Floats);
}

}  // namespace

Texture::Texture(const Image& image) {
  Level whole;
  whole.width = image.width;
  whole.height = image.height;
  whole.texels.reserve(image.samples8.size() / 4);
  for (std::size_t i = 0; i + 3 < image.samples8.size(); i += 4) {
    whole.texels.push_back(
        {image.samples8[i], image.samples8[i + 1], image.samples8[i + 2], image.samples8[i + 3]});
  }
  levels_.push_back(std::move(whole));
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    levels_.push_back(halved(levels_.back()));
  }
}

/// Halves a picture: each texel is the mean of four, weighted by their opacity, so holes have no
/// influence.
Texture::Level Texture::halved(const Level& level) {
  Level half;
  half.width = std::max(1, level.width / 2);
  half.height = std::max(1, level.height / 2);
  for (int row = 0; row < half.height; ++row) {
    for (int column = 0; column < half.width; ++column) {
      unsigned sum[3] = {0, 0, 0};
      unsigned opacity = 0;
      for (int k = 0; k < 4; ++k) {
        const Texel& texel = level.at(std::min(2 * column + (k & 1), level.width - 1),
                                      std::min(2 * row + (k >> 1), level.height - 1));
        for (std::size_t c = 0; c < 3; ++c) sum[c] += unsigned{texel[3]} * texel[c];
        opacity += texel[3];
      }
      Texel mean{0, 0, 0, static_cast<std::uint8_t>((opacity + 2) / 4)};
      for (std::size_t c = 0; c < 3 && opacity > 0; ++c) {
        mean[c] = static_cast<std::uint8_t>((sum[c] + opacity / 2) / opacity);
      }
      half.texels.push_back(mean);
    }
  }
  return half;
}

Color Texture::Level::bilinear(const Eigen::Vector2d& uv) const {
  // The coordinate starts at -0.5, so that adding one and truncating finds the texel to the left.
  const double x = fraction(uv.x()) * width - 0.5;
  const double y = (1.0 - fraction(uv.y())) * height - 0.5;
  const int left = static_cast<int>(x + 1.0) - 1;
  const int upper = static_cast<int>(y + 1.0) - 1;
  // k is at most one beyond the range [0, count), so no division is needed.
  const auto wrap = [](int k, int count) { return k < 0 ? k + count : k >= count ? k - count : k; };
  const int c0 = wrap(left, width), c1 = wrap(left + 1, width);
  const int r0 = wrap(upper, height), r1 = wrap(upper + 1, height);
  const auto a = static_cast<float>(x - left);
  const auto b = static_cast<float>(y - upper);
  const Floats upper_row = (1.0f - a) * floats_of(at(c0, r0)) + a * floats_of(at(c1, r0));
  const Floats lower_row = (1.0f - a) * floats_of(at(c0, r1)) + a * floats_of(at(c1, r1));
  const Floats mean = ((1.0f - b) * upper_row + b * lower_row) * (1.0f / 255.0f);
  return {mean[0], mean[1], mean[2], mean[3]};
}

Color Texture::color(const Eigen::Vector2d& uv, double footprint) const {
  if (!(uv.cwiseAbs().maxCoeff() < kFarthest)) return levels_.back().bilinear({0.0, 0.0});
  const int side = std::max(levels_.front().width, levels_.front().height);
  const float wanted =
      rough_log2(std::max(static_cast<float>(footprint) * static_cast<float>(side), 1.0f));
  const float last = static_cast<float>(levels_.size() - 1);
  const float level = std::min(wanted, last);
  const auto fine = static_cast<std::size_t>(level);
  const float part = level - static_cast<float>(fine);
  // Two copies are mixed only near the change from one to the other.
  const float share = std::min(1.0f, std::max(0.0f, 0.5f + (part - 0.5f) / kMixed));
  if (share == 0.0f) return levels_[fine].bilinear(uv);
  if (share == 1.0f) return levels_[fine + 1].bilinear(uv);
  return (1.0f - share) * levels_[fine].bilinear(uv) + share * levels_[fine + 1].bilinear(uv);
}

}  // namespace ardee::render
