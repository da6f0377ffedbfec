// SPDX-License-Identifier: MIT
#include "ardee_sim/core/normal_table.h"

#include <cmath>
#include <vector>

namespace ardee {

const NormalTable& NormalTable::get() {
  static const NormalTable table;
  return table;
}

/// The upper half, ascending; by Newton's method on the error function, each starting from its
/// neighbour.
NormalTable::NormalTable() {
  std::vector<double> exact(kHalf);
  double z = 0.0;
  double squares = 0.0;
  for (std::uint32_t k = 0; k < kHalf; ++k) {
    const double share_above = 0.5 - (k + 0.5) / (2.0 * kHalf);
    for (int iteration = 0; iteration < 8; ++iteration) {
      const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * M_PI);
      const double step = (0.5 * std::erfc(z / std::sqrt(2.0)) - share_above) / density;
      z += step;
      if (std::abs(step) < 1e-12) break;
    }
    exact[k] = z;
    squares += z * z;
  }
  const double scale = 1.0 / std::sqrt(squares / kHalf);
  upper_half_.reserve(exact.size());
  for (const double each : exact) upper_half_.push_back(static_cast<float>(scale * each));
}

}  // namespace ardee
