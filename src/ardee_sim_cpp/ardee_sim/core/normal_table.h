// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

namespace ardee {

/// Standard normal numbers for sixteen random bits: the 65536 quantiles of equal share, scaled to a
/// variance of 1; the largest is 4.3. For noise of many values, where a logarithm and a cosine each
/// would cost too much.
class NormalTable {
 public:
  static const NormalTable& get();

  float operator[](std::uint16_t bits) const {
    // The sign by its bit: a branch on noise could not be foreseen.
    std::uint32_t number;
    std::memcpy(&number, &upper_half_[bits & (kHalf - 1)], sizeof number);
    number |= (~std::uint32_t{bits} & kHalf) << 16;
    float signed_number;
    std::memcpy(&signed_number, &number, sizeof signed_number);
    return signed_number;
  }

 private:
  static constexpr std::uint32_t kHalf = 1u << 15;

  NormalTable();

  std::vector<float> upper_half_;
};

}  // namespace ardee
