// SPDX-License-Identifier: MIT
#include "ardee_sim/core/rng.h"

#include <cmath>

namespace ardee {
namespace {

double to_open_unit(std::uint64_t bits) {
  return (static_cast<double>(bits >> 11) + 0.5) * 0x1.0p-53;
}

}  // namespace

std::uint64_t stream_key(std::uint64_t root_seed, std::string_view name) {
  std::uint64_t hash = 0xCBF29CE484222325ULL;  // FNV-1a, 64 bits
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
  return mix_bits(mix_bits(root_seed + kGoldenGamma) ^ hash);
}

double CounterRng::uniform(std::uint64_t counter) const { return to_open_unit(bits(counter)); }

double CounterRng::normal(std::uint64_t counter) const {
  const double radius = std::sqrt(-2.0 * std::log(uniform(2 * counter)));
  return radius * std::cos(2.0 * M_PI * uniform(2 * counter + 1));
}

}  // namespace ardee
