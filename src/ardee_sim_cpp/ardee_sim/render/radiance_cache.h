// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <mutex>

#include "ardee_sim/core/rng.h"

namespace ardee::render {

/// Cache of light by key; new keys replace old ones. Many threads may use it at once; a key must
/// always stand for the same light.
class RadianceCache {
 public:
  /// Key of a number within a family; adjacent numbers are stored side by side. Two keys collide
  /// once in some 10^19 pairs.
  class CacheKey {
   public:
    CacheKey() = default;
    CacheKey(std::uint64_t family, std::uint64_t number)
        : check_(family + (number + 1) * kGoldenGamma), bucket_((family >> 32) + number / 2) {}

   private:
    friend class RadianceCache;
    std::uint64_t check_ = 0;
    std::uint64_t bucket_ = 0;
  };
  /// Stored form of a light: 13 binary digits of each colour.
  struct CachedRadiance {
    Eigen::Vector3f light{0, 0, 0};
    bool see_through = false;  // true: it has no light of its own
  };
  static CachedRadiance rounded(const CachedRadiance& kept) { return unpacked(packed(kept)); }

  /// Allocates the memory, once.
  void open();
  void prefetch(const CacheKey& name) const { __builtin_prefetch(&bucket(name)); }
  bool find(const CacheKey& name, CachedRadiance& kept) const;
  void keep(const CacheKey& name, const CachedRadiance& kept);

 private:
  /// Both words are written without a lock: a pair from two writers gives a wrong key, which is
  /// never found (Hyatt and Mann, A Lockless Transposition Table Implementation for Parallel
  /// Search, 2002).
  struct Entry {
    std::atomic<std::uint64_t> name_and_light;
    std::atomic<std::uint64_t> light;
  };
  static constexpr std::size_t kEntries = 4;
  struct alignas(64) Bucket {
    Entry entries[kEntries];
  };
  static constexpr std::size_t kBuckets = std::size_t{1} << 19;

  static std::uint64_t packed(const CachedRadiance& kept);
  static CachedRadiance unpacked(std::uint64_t bits);
  Bucket& bucket(const CacheKey& name) const { return buckets_[name.bucket_ % kBuckets]; }

  struct Free {
    void operator()(void* room) const { std::free(room); }
  };
  std::once_flag opened_;
  std::unique_ptr<Bucket[], Free> buckets_;
};

}  // namespace ardee::render
