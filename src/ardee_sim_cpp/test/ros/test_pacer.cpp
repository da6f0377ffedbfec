// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <thread>

#include "ros/pacer.h"

namespace ardee::node {
namespace {

constexpr TimeNs kSecond_ns = 1000000000;

TEST(Pacer, WithoutAFactorNeverWaits) {
  Pacer pacer;
  pacer.set_factor(0.0, 0);
  EXPECT_EQ(pacer.wait_s(100 * kSecond_ns), 0.0);
}

TEST(Pacer, WaitsForSimulatedTimeOverTheFactor) {
  Pacer pacer;
  pacer.set_factor(0.01, kSecond_ns);
  const double wait_s = pacer.wait_s(2 * kSecond_ns);  // 100 s, less what this test takes
  EXPECT_LE(wait_s, 100.0);
  EXPECT_GT(wait_s, 50.0);
}

TEST(Pacer, AfterALongLagStartsAnew) {
  Pacer pacer;
  pacer.set_factor(1.0, 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const double late_s = pacer.wait_s(0);
  EXPECT_LT(late_s, -0.1);
  EXPECT_GT(pacer.wait_s(0), late_s) << "on the old schedule it would be later still";
}

}  // namespace
}  // namespace ardee::node
