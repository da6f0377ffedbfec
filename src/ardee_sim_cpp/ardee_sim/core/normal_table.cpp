// SPDX-License-Identifier: MIT
#include "ardee_sim/core/normal_table.h"

#include <cmath>
#include <vector>

namespace ardee {
namespace {

constexpr int kHalf = 1 << 15;

/// The upper half, ascending; by Newton's method on the error function, each from its neighbour.
std::vector<float> make_upper_half() {
  std::vector<double> exact(kHalf);
  double z = 0.0;
  double squares = 0.0;
  for (int k = 0; k < kHalf; ++k) {
    const double share_above = 0.5 - (k + 0.5) / (2.0 * kHalf);
    for (int iteration = 0; iteration < 8; ++iteration) {
      const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * M_PI);
      const double step = (0.5 * std::erfc(z / std::sqrt(2.0)) - share_above) / density;
      z += step;
      if (std::abs(step) < 1e-12) break;
    }
    exact[static_cast<std::size_t>(k)] = z;
    squares += z * z;
  }
  const double scale = 1.0 / std::sqrt(squares / kHalf);
  std::vector<float> table;
  table.reserve(exact.size());
  for (const double each : exact) table.push_back(static_cast<float>(scale * each));
  return table;
}

}  // namespace

float normal_of_bits(std::uint16_t bits) {
  static const std::vector<float> kUpperHalf = make_upper_half();
  const float size = kUpperHalf[bits & (kHalf - 1)];
  return (bits & kHalf) != 0 ? size : -size;
}

}  // namespace ardee
