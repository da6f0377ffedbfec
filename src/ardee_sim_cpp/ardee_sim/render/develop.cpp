// SPDX-License-Identifier: MIT
#include "ardee_sim/render/develop.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ardee_sim/core/normal_table.h"
#include "ardee_sim/render/tone.h"

namespace ardee {
namespace {

const Eigen::Vector3f kLuma(0.299f, 0.587f, 0.114f);  // ITU-R BT.601

// Automatic exposure; nominal, chosen by eye on fields.
constexpr float kMiddleGrey = 0.32f;
constexpr float kLeastGain = 0.5f;
constexpr float kMostGain = 2.5f;
constexpr int kEvery = 4;  // each so many pixels, both ways, are metered

using Colors = std::array<int, 4>;  // of the upper two and lower two pixels of a Bayer square

const Colors* bayer(PixelFormat format) {
  static const Colors rggb{0, 1, 1, 2}, bggr{2, 1, 1, 0}, gbrg{1, 2, 0, 1}, grbg{1, 0, 2, 1};
  switch (format) {
    case PixelFormat::kBayerRggb8:
      return &rggb;
    case PixelFormat::kBayerBggr8:
      return &bggr;
    case PixelFormat::kBayerGbrg8:
      return &gbrg;
    case PixelFormat::kBayerGrbg8:
      return &grbg;
    default:
      return nullptr;
  }
}

/// Writes pixels of one frame; noise is drawn by the number of the pixel.
class Writer {
 public:
  Writer(const Development& how, const CounterRng& noise, float gain)
      : how_(how),
        noise_(noise),
        gain_(gain),
        mean_(static_cast<float>(how.noise_mean)),
        std_(static_cast<float>(how.noise_std)),
        bayer_(bayer(how.format)) {}

  void write(const Eigen::Vector3f& light, int column, int row, std::size_t pixel,
             std::uint8_t* out) const {
    const std::uint64_t bits = std_ > 0.0f ? noise_.bits(pixel) : 0;
    const auto value = [&](float brightness, int draw) {
      if (std_ <= 0.0f) return brightness + mean_;
      return brightness + mean_ + std_ * normals_[static_cast<std::uint16_t>(bits >> (16 * draw))];
    };
    const auto channel = [&](int c) { return value(tone(gain_ * light[c]), c); };
    switch (how_.format) {
      case PixelFormat::kRgb8:
      case PixelFormat::kBgr8: {
        // All three before the first is written: bytes could be a part of anything.
        const std::uint8_t red = to_byte(channel(0));
        const std::uint8_t green = to_byte(channel(1));
        const std::uint8_t blue = to_byte(channel(2));
        const bool red_first = how_.format == PixelFormat::kRgb8;
        out[0] = red_first ? red : blue;
        out[1] = green;
        out[2] = red_first ? blue : red;
        return;
      }
      case PixelFormat::kMono8:
        out[0] = to_byte(value(tone(gain_ * kLuma.dot(light)), 0));
        return;
      case PixelFormat::kMono16: {
        const float share = std::clamp(value(tone(gain_ * kLuma.dot(light)), 0), 0.0f, 1.0f);
        const auto number = static_cast<std::uint16_t>(65535.0f * share + 0.5f);
        out[0] = static_cast<std::uint8_t>(number & 0xFF);
        out[1] = static_cast<std::uint8_t>(number >> 8);
        return;
      }
      default:
        out[0] =
            to_byte(channel((*bayer_)[static_cast<std::size_t>(2 * (row & 1) + (column & 1))]));
    }
  }

 private:
  const Development& how_;
  const CounterRng& noise_;
  const float gain_;
  const float mean_;
  const float std_;
  const Colors* bayer_;
  const NormalTable& normals_ = NormalTable::get();
};

}  // namespace

int bytes_per_pixel(PixelFormat format) {
  switch (format) {
    case PixelFormat::kRgb8:
    case PixelFormat::kBgr8:
      return 3;
    case PixelFormat::kMono16:
      return 2;
    default:
      return 1;
  }
}

float automatic_exposure(const Frame& frame) {
  std::vector<float> brightness;
  for (int row = kEvery / 2; row < frame.height; row += kEvery) {
    for (int column = kEvery / 2; column < frame.width; column += kEvery) {
      brightness.push_back(kLuma.dot(frame.light[frame.index(column, row)]));
    }
  }
  if (brightness.empty()) return 1.0f;
  const auto middle = brightness.begin() + static_cast<std::ptrdiff_t>(brightness.size() / 2);
  std::nth_element(brightness.begin(), middle, brightness.end());
  return std::clamp(kMiddleGrey / std::max(*middle, 1e-3f), kLeastGain, kMostGain);
}

std::vector<std::uint8_t> develop(const Frame& frame, const Development& how,
                                  const CounterRng& noise) {
  const auto size = static_cast<std::size_t>(bytes_per_pixel(how.format));
  std::vector<std::uint8_t> bytes(frame.light.size() * size);
  const Writer writer(how, noise, how.exposure ? *how.exposure : automatic_exposure(frame));
  tbb::parallel_for(0, frame.height, [&](int row) {
    for (int column = 0; column < frame.width; ++column) {
      const std::size_t pixel = frame.index(column, row);
      writer.write(frame.light[pixel], column, row, pixel, &bytes[pixel * size]);
    }
  });
  return bytes;
}

}  // namespace ardee
