// SPDX-License-Identifier: MIT
#include "ardee_sim/render/image_formation.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <utility>

#include "ardee_sim/core/normal_table.h"
#include "ardee_sim/core/vector_clones.h"
#include "ardee_sim/render/tone.h"

namespace ardee::render {
namespace {

const Eigen::Vector3f kLuma(0.299f, 0.587f, 0.114f);  // ITU-R BT.601

// Constants of automatic exposure are nominal, chosen by eye on fields.
constexpr float kMiddleGrey = 0.32f;
constexpr float kLeastExposure = 0.5f;
constexpr float kMostExposure = 2.5f;
constexpr int kEvery = 4;  // distance of metered pixels, both ways

constexpr std::size_t kPiece = 64;  // pixels of a row that are processed together; an even number

template <std::size_t kEach>  // values a pixel
using Values = std::array<float, kEach * kPiece>;

using Colors = std::array<int, 2>;  // the even and the odd pixels of a row

Colors bayer(PixelFormat format, int row) {
  const bool upper = row % 2 == 0;
  switch (format) {
    case PixelFormat::kBayerRggb8:
      return upper ? Colors{0, 1} : Colors{1, 2};
    case PixelFormat::kBayerBggr8:
      return upper ? Colors{2, 1} : Colors{1, 0};
    case PixelFormat::kBayerGbrg8:
      return upper ? Colors{1, 2} : Colors{0, 1};
    default:
      return upper ? Colors{1, 0} : Colors{2, 1};
  }
}

/// Parameters of the exposure.
struct Exposure {
  float gain;
  float mean;  // of the noise, as a share of full brightness
  float std;
};

/// Computes values to be rounded down from light: brightness with noise, scaled so that full
/// brightness is `most`.
ARDEE_VECTOR_CLONES void expose(const Exposure& how, float most, const float* normals,
                                std::size_t count, float* values) {
  for (std::size_t k = 0; k < count; ++k) {
    const float noisy = tone(how.gain * values[k]) + how.mean + how.std * normals[k];
    const float from_black = noisy > 0.0f ? noisy : 0.0f;
    values[k] = most * (from_black < 1.0f ? from_black : 1.0f) + 0.5f;
  }
}

/// Writes pieces of the rows of one frame; the pixel's number selects its noise.
class Writer {
 public:
  Writer(const ImageFormation& how, const CounterRng& noise, float gain)
      : format_(how.format),
        noise_(noise),
        exposure_{gain, static_cast<float>(how.noise_mean), static_cast<float>(how.noise_std)} {}

  /// Writes `count` pixels from `pixel` on, whose column is even.
  void write(const Eigen::Vector3f* light, int row, std::size_t pixel, std::size_t count,
             std::uint8_t* out) const {
    switch (format_) {
      case PixelFormat::kRgb8:
      case PixelFormat::kBgr8:
        return write_colors(light, pixel, count, out);
      case PixelFormat::kMono8:
      case PixelFormat::kMono16:
        return write_grey(light, pixel, count, out);
      default:
        return write_bayer(light, bayer(format_, row), pixel, count, out);
    }
  }

 private:
  void write_colors(const Eigen::Vector3f* light, std::size_t pixel, std::size_t count,
                    std::uint8_t* out) const {
    static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
    Values<3> values{};
    std::memcpy(values.data(), light, count * sizeof(Eigen::Vector3f));
    auto bytes = numbers<std::uint8_t, 3>(values, pixel, {0, 0});
    if (format_ == PixelFormat::kBgr8) {
      for (std::size_t k = 0; k < bytes.size(); k += 3) std::swap(bytes[k], bytes[k + 2]);
    }
    std::memcpy(out, bytes.data(), 3 * count);
  }

  void write_grey(const Eigen::Vector3f* light, std::size_t pixel, std::size_t count,
                  std::uint8_t* out) const {
    Values<1> values{};
    for (std::size_t k = 0; k < count; ++k) values[k] = kLuma.dot(light[k]);
    if (format_ == PixelFormat::kMono8) {
      std::memcpy(out, numbers<std::uint8_t, 1>(values, pixel, {0, 0}).data(), count);
      return;
    }
    const auto words = numbers<std::uint16_t, 1>(values, pixel, {0, 0});
    for (std::size_t k = 0; k < count; ++k) {
      out[2 * k] = static_cast<std::uint8_t>(words[k] & 0xFF);
      out[2 * k + 1] = static_cast<std::uint8_t>(words[k] >> 8);
    }
  }

  void write_bayer(const Eigen::Vector3f* light, const Colors& colors, std::size_t pixel,
                   std::size_t count, std::uint8_t* out) const {
    Values<1> values{};
    for (std::size_t k = 0; k < count; ++k) values[k] = light[k][colors[k % 2]];
    std::memcpy(out, numbers<std::uint8_t, 1>(values, pixel, colors).data(), count);
  }

  /// Converts light to stored values. `draws`: see draw_normals().
  template <typename Number, std::size_t kEach>
  std::array<Number, kEach * kPiece> numbers(Values<kEach>& values, std::size_t pixel,
                                             const Colors& draws) const {
    Values<kEach> normals{};
    if (exposure_.std > 0.0f) draw_normals<kEach>(pixel, draws, normals);
    expose(exposure_, std::numeric_limits<Number>::max(), normals.data(), values.size(),
           values.data());
    std::array<Number, kEach * kPiece> rounded;
    for (std::size_t k = 0; k < rounded.size(); ++k) rounded[k] = static_cast<Number>(values[k]);
    return rounded;
  }

  /// Draws the noise. A pixel has four draws of sixteen bits; its values use them from number
  /// draws[0] in even columns, and from draws[1] in odd ones.
  template <std::size_t kEach>
  void draw_normals(std::size_t pixel, const Colors& draws, Values<kEach>& normals) const {
    std::array<std::uint16_t, kEach * kPiece + 3> bits;
    const auto draw = [&](std::size_t k, int first) {
      const std::uint64_t four = noise_.bits(pixel + k) >> (16 * first);
      // Little-endian: the first draw comes first. The next pixel's draws overwrite the unused
      // ones.
      std::memcpy(&bits[kEach * k], &four, sizeof four);
    };
    for (std::size_t k = 0; k < kPiece; k += 2) {
      draw(k, draws[0]);
      draw(k + 1, draws[1]);
    }
    normals_.look_up<kEach * kPiece>(bits.data(), normals.data());
  }

  const PixelFormat format_;
  const CounterRng noise_;
  const Exposure exposure_;
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
  return std::clamp(kMiddleGrey / std::max(*middle, 1e-3f), kLeastExposure, kMostExposure);
}

std::vector<std::uint8_t> form_image(const Frame& frame, const ImageFormation& how,
                                     const CounterRng& noise) {
  const auto size = static_cast<std::size_t>(bytes_per_pixel(how.format));
  std::vector<std::uint8_t> bytes(frame.light.size() * size);
  const Writer writer(how, noise, how.exposure ? *how.exposure : automatic_exposure(frame));
  const WhiteBalance& balance = how.white_balance;
  const Eigen::Vector3f gains = balance.automatic ? grey_world(frame) : balance.gains;
  const auto write_row = [&](int row) {
    const auto width = static_cast<std::size_t>(frame.width);
    std::array<Eigen::Vector3f, kPiece> balanced;
    for (std::size_t column = 0; column < width; column += kPiece) {
      const std::size_t pixel = frame.index(0, row) + column;
      const std::size_t count = std::min(kPiece, width - column);
      const Eigen::Vector3f* light = &frame.light[pixel];
      if (balance.is_on()) {
        for (std::size_t k = 0; k < count; ++k) balanced[k] = gains.cwiseProduct(light[k]);
        light = balanced.data();
      }
      writer.write(light, row, pixel, count, &bytes[pixel * size]);
    }
  };
  tbb::task_arena arena(frame.threads > 0 ? frame.threads : tbb::task_arena::automatic);
  arena.execute([&] { tbb::parallel_for(0, frame.height, write_row); });
  return bytes;
}

}  // namespace ardee::render
