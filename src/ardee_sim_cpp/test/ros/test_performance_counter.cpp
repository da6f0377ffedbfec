// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "ros/performance_metrics.h"

namespace ardee::node {
namespace {

constexpr TimeNs kMillisecond_ns = 1000000;

/// Counts from one report to the next: simulated time at three times the machine's.
void count(PerformanceCounter& counter, int from_ms, int to_ms) {
  for (int ms = from_ms + 1; ms <= to_ms; ++ms) {
    const PerformanceCounter::Moment now{ms * kMillisecond_ns, ms / 3000.0};
    if (ms % 25 == 0) counter.on_measured("robot::mast::lidar", false, now);
    if (ms % 100 == 0) counter.on_measured("robot::mast::eye", true, now);
    if (ms % 100 == 0) counter.on_measured("robot::mast::eye", true, now);  // its second topic
  }
}

PerformanceCounter::Moment at(int ms) { return {ms * kMillisecond_ns, ms / 3000.0}; }

TEST(PerformanceCounter, TellsRatesByBothClocks) {
  PerformanceCounter counter;
  counter.report(at(0));
  count(counter, 0, 1000);
  const auto report = counter.report(at(1000));
  EXPECT_NEAR(report.real_time_factor, 3.0, 1e-9);
  ASSERT_EQ(report.sensors.size(), 2u);
  const auto& eye = report.sensors[0];
  EXPECT_EQ(eye.name, "robot::mast::eye");
  EXPECT_NEAR(eye.sim_update_rate, 10.0, 1e-9);
  EXPECT_NEAR(eye.real_update_rate, 30.0, 1e-9);
  EXPECT_NEAR(eye.fps, 30.0, 1e-9);
  const auto& lidar = report.sensors[1];
  EXPECT_EQ(lidar.name, "robot::mast::lidar");
  EXPECT_NEAR(lidar.sim_update_rate, 40.0, 1e-9);
  EXPECT_NEAR(lidar.real_update_rate, 120.0, 1e-9);
  EXPECT_EQ(lidar.fps, -1.0);
}

TEST(PerformanceCounter, KeepsTheRateOfASensorSlowerThanItsReports) {
  PerformanceCounter counter;
  count(counter, 0, 210);
  EXPECT_NEAR(counter.report(at(210)).sensors.at(0).sim_update_rate, 10.0, 1e-9);
  count(counter, 210, 260);
  EXPECT_NEAR(counter.report(at(260)).sensors.at(0).sim_update_rate, 10.0, 1e-9);
}

TEST(PerformanceCounter, LeavesOutWhoHasLongBeenSilent) {
  PerformanceCounter counter;
  count(counter, 0, 1000);
  EXPECT_EQ(counter.report(at(1000)).sensors.size(), 2u);
  EXPECT_TRUE(counter.report({2000 * kMillisecond_ns, 10.0}).sensors.empty());
}

TEST(PerformanceCounter, GoesOnWhenTheClockIsSetBack) {
  PerformanceCounter counter;
  count(counter, 0, 1000);
  counter.report(at(1000));
  PerformanceCounter::Moment now{0, 1.0};
  EXPECT_EQ(counter.report(now).real_time_factor, 0.0);
  for (now.simulated_ns = 25 * kMillisecond_ns; now.simulated_ns <= 250 * kMillisecond_ns;
       now.simulated_ns += 25 * kMillisecond_ns) {
    now.wall_s += 0.05;
    counter.on_measured("robot::mast::lidar", false, now);
  }
  const auto report = counter.report(now);
  ASSERT_EQ(report.sensors.size(), 2u);
  EXPECT_NEAR(report.sensors[1].sim_update_rate, 40.0, 1e-9);
  EXPECT_NEAR(report.sensors[1].real_update_rate, 20.0, 1e-9);
}

}  // namespace
}  // namespace ardee::node
