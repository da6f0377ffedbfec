// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "ardee_sim/core/rng.h"

namespace ardee {
namespace {

constexpr int kDraws = 100000;

TEST(Rng, SameKeyAndCounterSameValueInAnyOrder) {
  const CounterRng a(stream_key(7, "lidar"));
  const CounterRng b(stream_key(7, "lidar"));
  const double late = a.normal(1000);
  for (int i = 0; i < 1000; ++i) a.normal(i);
  EXPECT_EQ(late, b.normal(1000));
}

TEST(Rng, StreamsDifferByNameSeedAndFrame) {
  std::set<std::uint64_t> values;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (const char* name : {"a", "b", "ab", "ba"}) {
      const CounterRng stream(stream_key(seed, name));
      for (int frame = 0; frame < 10; ++frame) values.insert(stream.frame(frame).bits(0));
    }
  }
  EXPECT_EQ(values.size(), 400u);
}

TEST(Rng, NormalHasMeanZeroVarianceOneAndNoCorrelation) {
  const CounterRng stream(stream_key(1, "normal"));
  double sum = 0.0;
  double squares = 0.0;
  double lagged = 0.0;
  double fourth = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = stream.normal(i);
    sum += x;
    squares += x * x;
    fourth += x * x * x * x;
    lagged += x * stream.normal(i + 1);
  }
  // Four standard errors of each estimate (probability of a miss 6e-5 each).
  EXPECT_NEAR(sum / kDraws, 0.0, 4.0 / std::sqrt(kDraws));
  EXPECT_NEAR(squares / kDraws, 1.0, 4.0 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(fourth / kDraws, 3.0, 4.0 * std::sqrt(96.0 / kDraws));
  EXPECT_NEAR(lagged / kDraws, 0.0, 4.0 / std::sqrt(kDraws));
}

TEST(Rng, UniformStaysInsideTheOpenInterval) {
  Rng rng(stream_key(3, "uniform"));
  double sum = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = rng.uniform();
    ASSERT_GT(x, 0.0);
    ASSERT_LT(x, 1.0);
    sum += x;
  }
  EXPECT_NEAR(sum / kDraws, 0.5, 4.0 / std::sqrt(12.0 * kDraws));
}

}  // namespace
}  // namespace ardee
