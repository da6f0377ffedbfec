// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "ardee_sim/core/time.h"

namespace ardee {
namespace {

constexpr TimeNs kMillisecond = 1000000;

std::vector<TimeNs> firings(double rate_hz, TimeNs step_ns, TimeNs end_ns) {
  RateTimer timer(rate_hz);
  timer.start_at(step_ns);
  std::vector<TimeNs> times;
  for (TimeNs now = step_ns; now <= end_ns; now += step_ns) {
    if (timer.due(now)) times.push_back(now);
  }
  return times;
}

TEST(RateTimer, ARateThatDividesTheStepIsPeriodic) {
  const auto times = firings(40.0, 5 * kMillisecond, 1000 * kMillisecond);
  ASSERT_EQ(times.size(), 40u);
  for (std::size_t k = 0; k < times.size(); ++k) {
    EXPECT_EQ(times[k], static_cast<TimeNs>(k + 1) * 25 * kMillisecond);
  }
}

TEST(RateTimer, ARateThatDoesNotKeepsItsMeanWithoutDrift) {
  // 30 Hz at a step of 7 ms over 70,000 s: exactly 2,100,000 periods, none off its grid by a step
  // or more.
  RateTimer timer(30.0);
  timer.start_at(1);
  std::uint64_t fired = 0;
  for (TimeNs now = 7 * kMillisecond; now <= 70000000LL * kMillisecond; now += 7 * kMillisecond) {
    if (!timer.due(now)) continue;
    ++fired;
    const double ideal_s = static_cast<double>(fired) / 30.0;
    ASSERT_GE(seconds(now), ideal_s - 1e-9);
    ASSERT_LT(seconds(now), ideal_s + 0.007);
  }
  EXPECT_EQ(fired, 2100000u);
}

TEST(RateTimer, ZeroMeansEachStepAndARateAboveTheStepsIsNotMadeUpFor) {
  EXPECT_EQ(firings(0.0, kMillisecond, 100 * kMillisecond).size(), 100u);
  EXPECT_EQ(firings(5000.0, kMillisecond, 100 * kMillisecond).size(), 100u);
}

TEST(RateTimer, AnyRateAboveTheStepsIsEachStep) {
  for (const double rate_hz : {1e9, 1e25, 1e300}) {
    EXPECT_EQ(firings(rate_hz, kMillisecond, 100 * kMillisecond).size(), 100u) << rate_hz;
  }
}

TEST(RateTimer, APeriodOfMoreThanCenturiesNeverEnds) {
  for (const double rate_hz : {1e-10, 1e-300}) {
    EXPECT_TRUE(firings(rate_hz, kMillisecond, 100 * kMillisecond).empty()) << rate_hz;
    RateTimer timer(rate_hz, kMillisecond);
    EXPECT_TRUE(timer.due(kMillisecond));
    EXPECT_FALSE(timer.due(2 * kMillisecond)) << rate_hz;
  }
}

TEST(RateTimer, StartingLaterKeepsTheGrid) {
  RateTimer timer(10.0);
  timer.start_at(123 * kMillisecond);
  EXPECT_FALSE(timer.due(199 * kMillisecond));
  EXPECT_TRUE(timer.due(200 * kMillisecond));
  EXPECT_EQ(timer.count(), 3u);  // 0, 100 and 200 ms
}

TEST(Time, RoundsToTheNearestNanosecond) {
  EXPECT_EQ(nanoseconds(0.005), 5 * kMillisecond);
  EXPECT_EQ(nanoseconds(0.1 + 0.2), 300 * kMillisecond);
}

TEST(Time, HasNoEndBeyondCenturies) {
  constexpr TimeNs kLast = std::numeric_limits<TimeNs>::max();
  EXPECT_EQ(nanoseconds(1e10), kLast);
  EXPECT_EQ(nanoseconds(std::numeric_limits<double>::infinity()), kLast);
  EXPECT_EQ(nanoseconds(-1e300), -kLast);
  EXPECT_EQ(nanoseconds(9e9), 9000000000000000000);
}

TEST(RateTimer, offset_moves_all_firings) {
  RateTimer timer(4.0, 100000000);
  std::vector<TimeNs> fired_ms;
  for (TimeNs now_ms = 0; now_ms <= 1000; now_ms += 10) {
    if (timer.due(now_ms * 1000000)) fired_ms.push_back(now_ms);
  }
  EXPECT_EQ(fired_ms, (std::vector<TimeNs>{100, 350, 600, 850}));
  timer.start_at(400000000);
  EXPECT_EQ(timer.count(), 2u);
}

}  // namespace
}  // namespace ardee
