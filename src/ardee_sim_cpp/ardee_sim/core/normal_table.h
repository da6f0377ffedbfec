// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace ardee {

/// Standard normal number for sixteen random bits: the 65536 quantiles of equal share, scaled to a
/// variance of 1; the largest is 4.3. For noise of many values, where a logarithm and a cosine each
/// would cost too much.
float normal_of_bits(std::uint16_t bits);

}  // namespace ardee
