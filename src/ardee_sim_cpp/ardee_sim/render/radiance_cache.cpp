// SPDX-License-Identifier: MIT
#include "ardee_sim/render/radiance_cache.h"

#include <sys/mman.h>

#include <cstdlib>
#include <cstring>
#include <new>

namespace ardee::render {
namespace {

/// Bits kept of a float that is not negative: its whole exponent, and the leading digits.
constexpr int kColorBits = 20;
constexpr int kCutBits = 31 - kColorBits;
constexpr std::uint64_t kColorMask = (1u << kColorBits) - 1;
constexpr std::size_t kLargePage_bytes = std::size_t{1} << 21;
constexpr std::uint64_t kSeeThrough = std::uint64_t{1} << 63;

}  // namespace

std::uint64_t RadianceCache::packed(const CachedRadiance& kept) {
  if (kept.see_through) return kSeeThrough;
  std::uint64_t result = 0;
  for (int k = 0; k < 3; ++k) {
    const float color = kept.light[k] > 0.0f ? kept.light[k] : 0.0f;
    std::uint32_t bits;
    std::memcpy(&bits, &color, sizeof bits);
    result |= std::uint64_t{(bits + (1u << (kCutBits - 1))) >> kCutBits} << (k * kColorBits);
  }
  return result;
}

RadianceCache::CachedRadiance RadianceCache::unpacked(std::uint64_t bits) {
  CachedRadiance kept;
  kept.see_through = bits == kSeeThrough;
  if (kept.see_through) return kept;
  for (int k = 0; k < 3; ++k) {
    const auto color = static_cast<std::uint32_t>((bits >> (k * kColorBits)) & kColorMask)
                       << kCutBits;
    std::memcpy(&kept.light[k], &color, sizeof color);
  }
  return kept;
}

void RadianceCache::open() {
  std::call_once(opened_, [this] {
    constexpr std::size_t kBytes = kBuckets * sizeof(Bucket);
    void* room = std::aligned_alloc(kLargePage_bytes, kBytes);
    if (room == nullptr) throw std::bad_alloc();
    // Look-ups are scattered: use large pages if the system has them.
    madvise(room, kBytes, MADV_HUGEPAGE);
    buckets_.reset(new (room) Bucket[kBuckets]());
  });
}

bool RadianceCache::find(const CacheKey& name, CachedRadiance& kept) const {
  for (const Entry& entry : bucket(name).entries) {
    const std::uint64_t light = entry.light.load(std::memory_order_relaxed);
    if ((entry.name_and_light.load(std::memory_order_relaxed) ^ light) == name.check_) {
      kept = unpacked(light);
      return true;
    }
  }
  return false;
}

void RadianceCache::keep(const CacheKey& name, const CachedRadiance& kept) {
  Bucket& all = bucket(name);
  Entry* place = &all.entries[name.check_ >> 32 & (kEntries - 1)];
  for (Entry& entry : all.entries) {
    if (entry.name_and_light.load(std::memory_order_relaxed) != 0) continue;
    place = &entry;
    break;
  }
  const std::uint64_t light = packed(kept);
  place->light.store(light, std::memory_order_relaxed);
  place->name_and_light.store(name.check_ ^ light, std::memory_order_relaxed);
}

}  // namespace ardee::render
