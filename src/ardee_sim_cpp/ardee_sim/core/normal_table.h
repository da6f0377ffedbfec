// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
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
    return with_sign(upper_half_[bits & (kHalf - 1)], bits);
  }

  /// Those for `kCount` times sixteen bits: the same numbers, sooner.
  template <std::size_t kCount>
  void look_up(const std::uint16_t* bits, float* numbers) const {
    const float* const half = upper_half_.data();
    for (std::size_t k = 0; k < kCount; ++k) numbers[k] = half[bits[k] & (kHalf - 1)];
    // A loop of its own: of this one the compiler makes vector instructions.
    for (std::size_t k = 0; k < kCount; ++k) numbers[k] = with_sign(numbers[k], bits[k]);
  }

 private:
  static constexpr std::uint32_t kHalf = 1u << 15;

  NormalTable();

  /// By its bit: a branch on noise could not be foreseen.
  static float with_sign(float positive, std::uint16_t bits) {
    std::uint32_t number;
    std::memcpy(&number, &positive, sizeof number);
    number |= (~std::uint32_t{bits} & kHalf) << 16;
    std::memcpy(&positive, &number, sizeof number);
    return positive;
  }

  std::vector<float> upper_half_;
};

}  // namespace ardee
