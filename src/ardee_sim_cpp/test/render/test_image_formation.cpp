// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "ardee_sim/core/normal_table.h"
#include "ardee_sim/render/image_formation.h"
#include "ardee_sim/render/tone.h"

namespace ardee {
using namespace render;
namespace {

Frame even_frame(int width, int height, const Eigen::Vector3f& light) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  frame.light.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), light);
  return frame;
}

ImageFormation fixed(PixelFormat format, double noise_std = 0.0) {
  ImageFormation how;
  how.format = format;
  how.exposure = 1.0f;
  how.noise_std = noise_std;
  return how;
}

TEST(Develop, PutsColoursWhereTheFormatSays) {
  const Frame frame = even_frame(2, 2, {0.2f, 0.4f, 0.6f});
  using Bytes = std::vector<std::uint8_t>;
  const auto first = [&](PixelFormat format, std::size_t count) {
    Bytes bytes = form_image(frame, fixed(format), CounterRng(1));
    bytes.resize(count);
    return bytes;
  };
  EXPECT_EQ(first(PixelFormat::kRgb8, 3), (Bytes{51, 102, 153}));
  EXPECT_EQ(first(PixelFormat::kBgr8, 3), (Bytes{153, 102, 51}));
  EXPECT_EQ(first(PixelFormat::kMono8, 1), (Bytes{93}));  // 0.299 * 51 + 0.587 * 102 + 0.114 * 153
  EXPECT_EQ(first(PixelFormat::kBayerRggb8, 4), (Bytes{51, 102, 102, 153}));
  EXPECT_EQ(first(PixelFormat::kBayerGbrg8, 4), (Bytes{102, 153, 51, 102}));
  const Bytes mono16 = first(PixelFormat::kMono16, 2);
  EXPECT_NEAR((mono16[0] + 256 * mono16[1]) / 65535.0, 0.363, 1e-4);
}

/// Returns light from below zero to far above white.
Frame uneven_frame(int width, int height) {
  Frame frame = even_frame(width, height, {0, 0, 0});
  const CounterRng draws(11);
  for (std::size_t i = 0; i < 3 * frame.light.size(); ++i) {
    frame.light[i / 3][i % 3] = static_cast<float>(-0.1 + 3.0 * std::pow(draws.uniform(i), 3));
  }
  return frame;
}

/// Returns one value by the formula: `draw` is which of the pixel's four draws of noise it uses.
float value(float light, const ImageFormation& how, std::uint64_t bits, int draw) {
  const float brightness = tone(*how.exposure * light) + static_cast<float>(how.noise_mean);
  if (how.noise_std == 0.0) return brightness;
  const auto number = static_cast<std::uint16_t>(bits >> (16 * draw));
  return brightness + static_cast<float>(how.noise_std) * NormalTable::get()[number];
}

/// Returns the bytes of one pixel. `colors`: its values as the letters R, G, B, or W for grey.
std::vector<std::uint8_t> pixel_bytes(const Eigen::Vector3f& light, const std::string& colors,
                                      const ImageFormation& how, std::uint64_t bits) {
  std::vector<std::uint8_t> bytes;
  for (const char color : colors) {
    const auto number = static_cast<int>(std::string("RGB").find(color));
    const float found =
        color == 'W' ? value(Eigen::Vector3f(0.299f, 0.587f, 0.114f).dot(light), how, bits, 0)
                     : value(light[number], how, bits, number);
    if (how.format == PixelFormat::kMono16) {
      const auto word = static_cast<std::uint16_t>(65535.0f * std::clamp(found, 0.0f, 1.0f) + 0.5f);
      bytes.insert(bytes.end(),
                   {static_cast<std::uint8_t>(word % 256), static_cast<std::uint8_t>(word / 256)});
    } else {
      bytes.push_back(to_byte(found));
    }
  }
  return bytes;
}

TEST(Develop, FollowsTheFormulaPixelByPixel) {
  // Colours are those of even and odd columns, first in even and then in odd rows.
  const std::pair<PixelFormat, std::array<std::string, 4>> kFormats[] = {
      {PixelFormat::kRgb8, {"RGB", "RGB", "RGB", "RGB"}},
      {PixelFormat::kBgr8, {"BGR", "BGR", "BGR", "BGR"}},
      {PixelFormat::kMono8, {"W", "W", "W", "W"}},
      {PixelFormat::kMono16, {"W", "W", "W", "W"}},
      {PixelFormat::kBayerRggb8, {"R", "G", "G", "B"}},
      {PixelFormat::kBayerBggr8, {"B", "G", "G", "R"}},
      {PixelFormat::kBayerGbrg8, {"G", "B", "R", "G"}},
      {PixelFormat::kBayerGrbg8, {"G", "R", "B", "G"}}};
  const CounterRng noise(5);
  for (const int width : {1, 2, 63, 64, 65, 131}) {
    const Frame frame = uneven_frame(width, 3);
    for (const auto& [format, colors] : kFormats) {
      for (const double noise_std : {0.0, 0.007, 0.2}) {
        ImageFormation how = fixed(format, noise_std);
        how.exposure = 1.3f;
        how.noise_mean = 0.02;
        std::vector<std::uint8_t> expected;
        for (std::size_t i = 0; i < frame.light.size(); ++i) {
          const std::size_t row = i / static_cast<std::size_t>(width);
          const std::size_t column = i % static_cast<std::size_t>(width);
          const auto bytes =
              pixel_bytes(frame.light[i], colors[2 * (row % 2) + column % 2], how, noise.bits(i));
          expected.insert(expected.end(), bytes.begin(), bytes.end());
        }
        EXPECT_EQ(form_image(frame, how, noise), expected)
            << "width " << width << ", format " << static_cast<int>(format) << ", noise "
            << noise_std;
      }
    }
  }
}

TEST(Develop, LightThatIsNoNumberIsBlackAndInfiniteLightIsWhite) {
  const Frame frame = even_frame(1, 1, {NAN, INFINITY, -INFINITY});
  EXPECT_EQ(form_image(frame, fixed(PixelFormat::kRgb8), CounterRng(1)),
            (std::vector<std::uint8_t>{0, 255, 0}));
}

TEST(Develop, NoiseHasTheStatedDeviationAndIsNotShared) {
  constexpr double kStd = 0.05;
  const Frame frame = even_frame(200, 200, {0.5f, 0.5f, 0.5f});
  const auto bytes = form_image(frame, fixed(PixelFormat::kRgb8, kStd), CounterRng(7));
  double sum = 0.0, squares = 0.0, product = 0.0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const double error = bytes[i] / 255.0 - 0.5;
    sum += error;
    squares += error * error;
    if (i % 3 == 0) product += error * (bytes[i + 1] / 255.0 - 0.5);
  }
  const double n = static_cast<double>(bytes.size());
  const double quantised = std::sqrt(kStd * kStd + 1.0 / (12.0 * 255 * 255));
  // The bound is four standard errors.
  EXPECT_NEAR(sum / n, 0.0, 4.0 * kStd / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), quantised, 4.0 * kStd / std::sqrt(2.0 * n));
  EXPECT_NEAR(product / (n / 3), 0.0, 4.0 * kStd * kStd / std::sqrt(n / 3));
}

TEST(Develop, AutomaticExposureLiftsADarkSceneAndLowersABrightOne) {
  const float dark = automatic_exposure(even_frame(40, 40, {0.2f, 0.2f, 0.2f}));
  const float bright = automatic_exposure(even_frame(40, 40, {0.6f, 0.6f, 0.6f}));
  EXPECT_NEAR(0.2f * dark, 0.6f * bright, 1e-5f);
  EXPECT_GT(dark, 1.0f);
  EXPECT_LT(bright, 1.0f);
  EXPECT_EQ(automatic_exposure(even_frame(40, 40, {0, 0, 0})),
            automatic_exposure(even_frame(40, 40, {0.01f, 0, 0})));  // within limits
}

TEST(Develop, WhiteBalanceMultipliesTheLight) {
  const Frame frame = uneven_frame(70, 3);
  ImageFormation how = fixed(PixelFormat::kRgb8, 0.02);
  how.white_balance = *parse_white_balance("1.25 1 0.5");
  Frame multiplied = frame;
  for (Eigen::Vector3f& light : multiplied.light)
    light = {1.25f * light[0], light[1], 0.5f * light[2]};
  EXPECT_EQ(form_image(frame, how, CounterRng(3)),
            form_image(multiplied, fixed(PixelFormat::kRgb8, 0.02), CounterRng(3)));
  how.white_balance = *parse_white_balance("off");
  EXPECT_EQ(form_image(frame, how, CounterRng(3)),
            form_image(frame, fixed(PixelFormat::kRgb8, 0.02), CounterRng(3)));
}

TEST(Develop, AGreyWorldHasEqualMeans) {
  Frame frame = even_frame(8, 8, {0.2f, 0.4f, 0.1f});
  frame.light[3] = {0.5f, 0.3f, 0.2f};
  ImageFormation how = fixed(PixelFormat::kRgb8);
  how.white_balance = *parse_white_balance("auto");
  const Eigen::Vector3f gains = grey_world(frame);
  EXPECT_NEAR(gains[0], (63 * 0.4 + 0.3) / (63 * 0.2 + 0.5), 1e-5);
  EXPECT_NEAR(gains[2], (63 * 0.4 + 0.3) / (63 * 0.1 + 0.2), 1e-5);
  const auto bytes = form_image(frame, how, CounterRng(1));
  EXPECT_EQ(bytes[0], 99);  // 255 * 0.2 * gains[0]
  EXPECT_EQ(bytes[1], 102);
  EXPECT_EQ(bytes[2], 100);
  EXPECT_EQ(grey_world(even_frame(8, 8, {0, 0, 0})), Eigen::Vector3f(1, 1, 1));
  EXPECT_EQ(grey_world(even_frame(8, 8, {0.9f, 0.1f, 0.001f})), Eigen::Vector3f(0.25f, 1.0f, 4.0f));
}

TEST(Develop, DaylightOfATemperatureIsShownAsGrey) {
  // sRGB's white is D65; D50, x 0.3457 and y 0.3585, is (1.1763, 0.9757, 0.7218) in linear sRGB.
  EXPECT_NEAR((daylight_gains(6504.0) - Eigen::Vector3f(1, 1, 1)).norm(), 0.0, 2e-3);
  const Eigen::Vector3f d50 = daylight_gains(5003.0);
  EXPECT_NEAR(d50[0], std::pow(0.9757 / 1.1763, 1 / 2.2), 2e-3);
  EXPECT_EQ(d50[1], 1.0f);
  EXPECT_NEAR(d50[2], std::pow(0.9757 / 0.7218, 1 / 2.2), 2e-3);
  for (const char* bad :
       {"", "on", "3999", "25001", "1 2", "1 2 3 4", "1 0 1", "1 1 nan", "5000 K"}) {
    EXPECT_FALSE(parse_white_balance(bad)) << bad;
  }
}

}  // namespace
}  // namespace ardee
