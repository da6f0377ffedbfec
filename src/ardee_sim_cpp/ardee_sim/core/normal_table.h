// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace ardee {

/// Standard normal numbers for sixteen random bits: the 65536 quantiles of equal share, scaled to a
/// variance of 1; the largest is 4.3. For noise of many values, where a logarithm and a cosine each
/// would cost too much.
class NormalTable {
 public:
  static const NormalTable& get();

  float operator[](std::uint16_t bits) const {
    const float size = upper_half_[bits & (kHalf - 1)];
    return (bits & kHalf) != 0 ? size : -size;
  }

 private:
  static constexpr int kHalf = 1 << 15;

  NormalTable();

  std::vector<float> upper_half_;
};

}  // namespace ardee
