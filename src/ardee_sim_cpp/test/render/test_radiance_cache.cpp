// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

#include "ardee_sim/core/rng.h"
#include "ardee_sim/render/radiance_cache.h"

namespace ardee::test {
using namespace render;
namespace {

using CachedRadiance = RadianceCache::CachedRadiance;

/// Returns the light of a key, so that each place in a cache can be checked.
CachedRadiance light_of(std::uint64_t family, std::uint64_t number) {
  const std::uint64_t bits = mix_bits(family ^ mix_bits(number));
  const auto share = [bits](int k) {
    return static_cast<float>(bits >> (16 * k) & 0xFFFF) / 65536.0f;
  };
  return RadianceCache::rounded({{share(0), share(1), share(2)}, false});
}

TEST(RadianceCache, RoundsToThirteenBinaryDigits) {
  for (const float light : {0.0f, 1e-6f, 0.0123f, 0.5f, 0.999f, 1.0f, 7.3f, 1e5f}) {
    const CachedRadiance kept = RadianceCache::rounded({{light, 0.5f * light, 0.0f}, false});
    EXPECT_NEAR(kept.light.x(), light, std::ldexp(light, -13));
    EXPECT_NEAR(kept.light.y(), 0.5f * light, std::ldexp(0.5f * light, -13));
    EXPECT_EQ(kept.light.z(), 0.0f);
    EXPECT_EQ(RadianceCache::rounded(kept).light, kept.light);
  }
  EXPECT_EQ(RadianceCache::rounded({{-1.0f, 0.0f, 0.0f}, false}).light.x(), 0.0f);
}

TEST(RadianceCache, FindsWhatWasKeptAndNothingElse) {
  RadianceCache store;
  store.open();
  CachedRadiance found;
  EXPECT_FALSE(store.find({0, 0}, found));
  store.keep({7, 3}, light_of(7, 3));
  store.keep({7, 4}, {Eigen::Vector3f::Zero(), true});
  ASSERT_TRUE(store.find({7, 3}, found));
  EXPECT_EQ(found.light, light_of(7, 3).light);
  EXPECT_FALSE(found.see_through);
  ASSERT_TRUE(store.find({7, 4}, found));
  EXPECT_TRUE(found.see_through);
  EXPECT_FALSE(store.find({7, 2}, found));
  EXPECT_FALSE(store.find({8, 3}, found));
}

TEST(RadianceCache, GivesUpOldNamesForNewOnes) {
  RadianceCache store;
  store.open();
  // All keys have one place: the families' upper halves and the number choose it.
  constexpr std::uint64_t kNames = 40;
  for (std::uint64_t family = 1; family <= kNames; ++family) {
    store.keep({family, 0}, light_of(family, 0));
    CachedRadiance found;
    ASSERT_TRUE(store.find({family, 0}, found)) << family;
    EXPECT_EQ(found.light, light_of(family, 0).light);
  }
  int left = 0;
  for (std::uint64_t family = 1; family <= kNames; ++family) {
    CachedRadiance found;
    if (!store.find({family, 0}, found)) continue;
    ++left;
    EXPECT_EQ(found.light, light_of(family, 0).light) << family;
  }
  EXPECT_EQ(left, 4);
}

TEST(RadianceCache, NeverMixesWhatSeveralThreadsKeep) {
  RadianceCache store;
  store.open();
  std::atomic<int> wrong{0};
  std::atomic<int> right{0};
  std::vector<std::thread> threads;
  for (std::uint64_t thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&, thread] {
      for (int k = 0; k < 200000; ++k) {
        const std::uint64_t bits = mix_bits(static_cast<std::uint64_t>(k) * 4 + thread);
        // There are few places, and many keys for each.
        const std::uint64_t family = bits % 50;
        const std::uint64_t number = bits >> 32 & 7;
        CachedRadiance found;
        if (store.find({family, number}, found)) {
          const bool same = found.light == light_of(family, number).light && !found.see_through;
          ++(same ? right : wrong);
        } else {
          store.keep({family, number}, light_of(family, number));
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(right, 1000);
}

}  // namespace
}  // namespace ardee::test
