// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "ardee_sim/render/develop.h"

namespace ardee {
namespace {

Frame even_frame(int width, int height, const Eigen::Vector3f& light) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  frame.light.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), light);
  return frame;
}

Development fixed(PixelFormat format, double noise_std = 0.0) {
  Development how;
  how.format = format;
  how.exposure = 1.0f;
  how.noise_std = noise_std;
  return how;
}

TEST(Develop, PutsColoursWhereTheFormatSays) {
  const Frame frame = even_frame(2, 2, {0.2f, 0.4f, 0.6f});
  using Bytes = std::vector<std::uint8_t>;
  const auto first = [&](PixelFormat format, std::size_t count) {
    Bytes bytes = develop(frame, fixed(format), CounterRng(1));
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

TEST(Develop, NoiseHasTheStatedDeviationAndIsNotShared) {
  constexpr double kStd = 0.05;
  const Frame frame = even_frame(200, 200, {0.5f, 0.5f, 0.5f});
  const auto bytes = develop(frame, fixed(PixelFormat::kRgb8, kStd), CounterRng(7));
  double sum = 0.0, squares = 0.0, product = 0.0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const double error = bytes[i] / 255.0 - 0.5;
    sum += error;
    squares += error * error;
    if (i % 3 == 0) product += error * (bytes[i + 1] / 255.0 - 0.5);
  }
  const double n = static_cast<double>(bytes.size());
  const double quantised = std::sqrt(kStd * kStd + 1.0 / (12.0 * 255 * 255));
  // Four standard errors.
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

}  // namespace
}  // namespace ardee
