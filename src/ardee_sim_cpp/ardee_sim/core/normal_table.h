// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace ardee {

/// Table that maps sixteen random bits to a standard normal number: the 65536 quantiles of equal
/// probability, scaled to a variance of 1; the largest is 4.3. It serves noise of many values, for
/// which a logarithm and a cosine per value would cost too much.
class NormalTable {
 public:
  static const NormalTable& get();

  float operator[](std::uint16_t bits) const {
    return with_sign(upper_half_[bits & (kHalf - 1)], bits);
  }

  /// Numbers for `kCount` times sixteen bits: equal to `kCount` single look-ups, but faster.
  template <std::size_t kCount>
  void look_up(const std::uint16_t* bits, float* numbers) const {
    const float* const half = upper_half_.data();
    for (std::size_t k = 0; k < kCount; ++k) numbers[k] = half[bits[k] & (kHalf - 1)];
    // A separate loop, because the compiler can vectorise it.
    for (std::size_t k = 0; k < kCount; ++k) numbers[k] = with_sign(numbers[k], bits[k]);
  }

 private:
  static constexpr std::uint32_t kHalf = 1u << 15;

  NormalTable();

  /// Sets the sign by its bit: the processor cannot predict a branch on noise.
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
