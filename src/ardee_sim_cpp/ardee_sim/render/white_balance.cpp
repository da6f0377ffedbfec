// SPDX-License-Identifier: MIT
#include "ardee_sim/render/white_balance.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "ardee_sim/render/srgb.h"

namespace ardee::render {
namespace {

constexpr float kMostAutomatic = 4.0f;  // gain of grey_world, and least of its inverse (nominal)
constexpr double kCoolest_k = 4000.0, kWarmest_k = 25000.0;  // of CIE's formula for daylight
constexpr double kLeastGain = 0.01, kMostGain = 100.0;

}  // namespace

Eigen::Vector3f grey_world(const Frame& frame) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& light : frame.light) sum += light.cast<double>();
  if (!(sum.minCoeff() > 0.0)) return {1, 1, 1};
  const Eigen::Vector3f gains = (sum[1] / sum.array()).cast<float>();
  return gains.cwiseMax(1.0f / kMostAutomatic).cwiseMin(kMostAutomatic);
}

Eigen::Vector3f daylight_gains(double temperature_k) {
  const double t = 1e3 / temperature_k;
  const double x = temperature_k <= 7000.0 ? 0.244063 + t * (0.09911 + t * (2.9678 - t * 4.6070))
                                           : 0.237040 + t * (0.24748 + t * (1.9018 - t * 2.0064));
  const double y = -0.275 + x * (2.870 - x * 3.000);
  const Eigen::Vector3f shown = linear_srgb(x, y, 1.0).array().pow(1.0f / 2.2f);
  return shown[1] / shown.array();
}

std::optional<WhiteBalance> parse_white_balance(const std::string& text) {
  WhiteBalance read;
  if (text == "off") return read;
  read.automatic = text == "auto";
  if (read.automatic) return read;
  std::istringstream stream(text);
  std::vector<double> numbers;
  double number = 0.0;
  while (stream >> number) numbers.push_back(number);
  if (!stream.eof()) return std::nullopt;
  if (numbers.size() == 1 && number >= kCoolest_k && number <= kWarmest_k) {
    read.gains = daylight_gains(number);
    return read;
  }
  const auto is_gain = [](double gain) { return gain >= kLeastGain && gain <= kMostGain; };
  if (numbers.size() != 3 || !std::all_of(numbers.begin(), numbers.end(), is_gain)) {
    return std::nullopt;
  }
  read.gains = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]).cast<float>();
  return read;
}

}  // namespace ardee::render
