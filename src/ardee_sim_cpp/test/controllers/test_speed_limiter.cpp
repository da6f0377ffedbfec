// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/speed_limiter.h"
#include "rig.h"

namespace ardee::control {
namespace {

SpeedLimiter limiter(const Parameters& parameters) { return {settings_of(parameters), "linear/x"}; }

TEST(SpeedLimiter, LetsPassWhatNoLimitIsSetFor) {
  SpeedLimiter none = limiter({{"linear/x/max_velocity", 1.0}, {"linear/x/max_acceleration", 1.0}});
  EXPECT_EQ(none.limit(7.0, 0.1), 7.0);
  EXPECT_EQ(none.last(), 7.0);
}

TEST(SpeedLimiter, CutsSpeedsOfBothDirections) {
  SpeedLimiter even = limiter({{"linear/x/has_velocity_limits", true},  //
                               {"linear/x/max_velocity", 2.0}});
  EXPECT_EQ(even.limit(5.0, 0.1), 2.0);
  EXPECT_EQ(even.limit(-5.0, 0.1), -2.0);
  SpeedLimiter uneven = limiter({{"linear/x/has_velocity_limits", true},
                                 {"linear/x/max_velocity", 2.0},
                                 {"linear/x/min_velocity", -0.5}});
  EXPECT_EQ(uneven.limit(-5.0, 0.1), -0.5);
}

TEST(SpeedLimiter, ReadsKeysThatAreWrittenWithSlashes) {
  const Setting flat("/base",
                     Setting::Map{{"linear/x/has_velocity_limits", {"", true}},
                                  {"linear/x", {"", Setting::Map{{"max_velocity", {"", 2.0}}}}}});
  EXPECT_EQ(SpeedLimiter(flat, "linear/x").limit(5.0, 0.1), 2.0);
}

TEST(SpeedLimiter, RampsAtTheAcceleration) {
  SpeedLimiter ramp = limiter({{"linear/x/has_acceleration_limits", true},
                               {"linear/x/max_acceleration", 2.0},
                               {"linear/x/min_acceleration", -4.0}});
  for (int step = 1; step <= 5; ++step) {
    EXPECT_NEAR(ramp.limit(1.0, 0.1), 0.2 * step, 1e-12);
  }
  EXPECT_NEAR(ramp.limit(0.0, 0.1), 0.6, 1e-12);
  EXPECT_NEAR(ramp.limit(0.0, 0.1), 0.2, 1e-12);
  EXPECT_NEAR(ramp.limit(0.0, 0.1), 0.0, 1e-12);
}

TEST(SpeedLimiter, GrowsAsASquareUnderAJerkLimit) {
  SpeedLimiter jerk = limiter({{"linear/x/has_jerk_limits", true},  //
                               {"linear/x/max_jerk", 5.0}});
  // each step the change grows by 2 jerk dt^2 = 0.1: 0.1, 0.3, 0.6, 1.0
  for (const double expected : {0.1, 0.3, 0.6, 1.0}) {
    EXPECT_NEAR(jerk.limit(10.0, 0.1), expected, 1e-12);
  }
}

TEST(SpeedLimiter, BoundsTheJerkFirstThenAccelerationThenSpeed) {
  SpeedLimiter all = limiter({{"linear/x/has_jerk_limits", true},
                              {"linear/x/max_jerk", 5.0},
                              {"linear/x/has_acceleration_limits", true},
                              {"linear/x/max_acceleration", 2.0},
                              {"linear/x/has_velocity_limits", true},
                              {"linear/x/max_velocity", 0.45}});
  for (const double expected : {0.1, 0.3, 0.45, 0.45}) {
    EXPECT_NEAR(all.limit(10.0, 0.1), expected, 1e-12);
  }
  all.reset();
  EXPECT_NEAR(all.limit(10.0, 0.1), 0.1, 1e-12);
}

TEST(SpeedLimiter, RefusesBoundsTheWrongWayRound) {
  EXPECT_EQ(message_of([] {
              limiter({{"linear/x/has_velocity_limits", true},
                       {"linear/x/max_velocity", 1.0},
                       {"linear/x/min_velocity", 2.0}});
            }),
            "/base/linear/x/min_velocity: found 2.000000, expected at most max_velocity, 1.000000");
}

}  // namespace
}  // namespace ardee::control
