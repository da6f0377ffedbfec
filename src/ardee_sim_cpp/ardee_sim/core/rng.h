// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/core/time.h"

namespace ardee {

/// Mixes 64 bits (the finaliser of SplitMix64: Steele, Lea, Flood, OOPSLA 2014).
inline std::uint64_t mix_bits(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9ULL;
  bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBULL;
  return bits ^ (bits >> 31);
}

/// 2^64 over the golden ratio.
constexpr std::uint64_t kGoldenGamma = 0x9E3779B97F4A7C15ULL;

/// Key of the random stream `name` under a root seed; a name gives an identical stream on every
/// machine.
std::uint64_t stream_key(std::uint64_t root_seed, std::string_view name);

/// Counter-based random numbers: the value at a counter is a pure function of (key, counter), so
/// that it cannot depend on the number of threads or on the order of evaluation.
class CounterRng {
 public:
  explicit CounterRng(std::uint64_t key) : key_(key) {}

  /// Separate stream for one frame (scan, image) of this stream.
  CounterRng frame(std::uint64_t index) const {
    return CounterRng(mix_bits(key_ ^ mix_bits(index)));
  }
  std::uint64_t bits(std::uint64_t counter) const {
    return mix_bits(key_ + (counter + 1) * kGoldenGamma);
  }
  /// Uniform in the open interval (0, 1).
  double uniform(std::uint64_t counter) const;
  /// Standard normal (Box and Muller 1958), two uniforms per value.
  double normal(std::uint64_t counter) const;
  void serialize(StateArchive& state) { state(key_); }

 private:
  std::uint64_t key_;
};

/// The key of a stream under another noise seed; under 0 it stays as it is.
inline std::uint64_t reseeded(std::uint64_t key, std::uint64_t noise_seed) {
  return noise_seed == 0 ? key : CounterRng(key).bits(noise_seed - 1);
}

/// A sequence of random numbers, for state that evolves in one fixed order (a drift, a bias walk).
class Rng {
 public:
  explicit Rng(std::uint64_t key) : stream_(key) {}
  /// Sequence for a start time; each start time has a different sequence.
  Rng(std::uint64_t key, TimeNs begin_ns)
      : stream_(CounterRng(key).frame(static_cast<std::uint64_t>(begin_ns))) {}

  double uniform() { return stream_.uniform(next_++); }
  double normal() { return stream_.normal(next_++); }
  void serialize(StateArchive& state) { state(stream_, next_); }

 private:
  CounterRng stream_;
  std::uint64_t next_ = 0;
};

}  // namespace ardee
