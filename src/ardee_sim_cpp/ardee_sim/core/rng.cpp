// SPDX-License-Identifier: MIT
#include "ardee_sim/core/rng.h"

#include <cmath>

namespace ardee {
namespace {

constexpr std::uint64_t kGoldenGamma = 0x9E3779B97F4A7C15ULL;

double to_open_unit(std::uint64_t bits) {
  return (static_cast<double>(bits >> 11) + 0.5) * 0x1.0p-53;
}

}  // namespace

std::uint64_t mix_bits(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9ULL;
  bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBULL;
  return bits ^ (bits >> 31);
}

std::uint64_t stream_key(std::uint64_t root_seed, std::string_view name) {
  std::uint64_t hash = 0xCBF29CE484222325ULL;  // FNV-1a, 64 bits
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
  return mix_bits(mix_bits(root_seed + kGoldenGamma) ^ hash);
}

std::uint64_t CounterRng::bits(std::uint64_t counter) const {
  return mix_bits(key_ + (counter + 1) * kGoldenGamma);
}

double CounterRng::uniform(std::uint64_t counter) const { return to_open_unit(bits(counter)); }

double CounterRng::normal(std::uint64_t counter) const {
  const double radius = std::sqrt(-2.0 * std::log(uniform(2 * counter)));
  return radius * std::cos(2.0 * M_PI * uniform(2 * counter + 1));
}

}  // namespace ardee
