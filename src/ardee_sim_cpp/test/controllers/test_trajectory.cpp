// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ardee_sim/controllers/trajectory.h"
#include "rig.h"

namespace ardee::control {
using namespace devices;
namespace {

void expect_motion(const JointMotion& motion, double position, double velocity,
                   double acceleration) {
  EXPECT_NEAR(motion.position, position, 1e-12);
  EXPECT_NEAR(motion.velocity, velocity, 1e-12);
  EXPECT_NEAR(motion.acceleration, acceleration, 1e-12);
}

TEST(Segment, IsALineWhereOneEndHasNoVelocity) {
  const Segment segment(1.0, {2.0, 0.5, 0.0}, 5.0, {4.0, {}, {}});
  expect_motion(segment.at(3.0), 3.0, 0.5, 0.0);
}

TEST(Segment, IsACubicWhereBothEndsHaveVelocities) {
  const Segment segment(1.0, {1.0, 0.5, 0.0}, 5.0, {3.0, -0.25, {}});
  // Half way: mean + T (v0 - v1) / 8; 3/2 way / T - (v0 + v1) / 4; (v1 - v0) / T.
  expect_motion(segment.at(3.0), 2.375, 0.6875, -0.1875);
  expect_motion(segment.at(1.0), 1.0, 0.5, 6.0 * 2.0 / 16.0 - (4.0 * 0.5 - 2.0 * 0.25) / 4.0);
  EXPECT_NEAR(segment.at(std::nextafter(5.0, 0.0)).velocity, -0.25, 1e-12);
}

TEST(Segment, IsAQuinticWhereBothEndsHaveAccelerations) {
  const Segment segment(0.0, {1.0, 0.5, 0.25}, 4.0, {3.0, -0.25, 0.75});
  // Half way: mean + 5 T (v0 - v1) / 32 + T^2 (a0 + a1) / 64;
  // 15/8 way / T - 7 (v0 + v1) / 16 + T (a1 - a0) / 32; 3 (v1 - v0) / (2 T) - (a0 + a1) / 4.
  expect_motion(segment.at(2.0), 2.0 + 0.46875 + 0.25, 0.9375 - 0.109375 + 0.0625, -0.28125 - 0.25);
  expect_motion(segment.at(0.0), 1.0, 0.5, 0.25);
  expect_motion(segment.at(std::nextafter(4.0, 0.0)), 3.0, -0.25, 0.75);
}

TEST(Segment, RestsAtItsEndsOutsideOfItsTime) {
  const Segment segment(1.0, {1.0, 0.5, {}}, 2.0, {3.0, 0.5, {}});
  expect_motion(segment.at(0.5), 1.0, 0.0, 0.0);
  expect_motion(segment.at(2.0), 3.0, 0.0, 0.0);
}

TEST(Segment, OfNoDurationIsWhereItBegins) {
  const JointPath path = resting_path(1.0, 0.7);
  for (const double time_s : {0.0, 1.0, 2.0}) expect_motion(path[0].at(time_s), 0.7, 0.0, 0.0);
}

TEST(Trajectory, StopsWithinADuration) {
  const JointPath path = stopping_path(1.0, {2.0, 0.8, 0.0}, 0.5);
  EXPECT_NEAR(segment_at(path, 1.0).at(1.0).velocity, 0.8, 1e-12);
  // A path there and back within 2 T turns after 5 (2 T) (2 v) / 32 = 5/8 v T.
  expect_motion(segment_at(path, 2.0).at(2.0), 2.0 + 0.625 * 0.8 * 0.5, 0.0, 0.0);
  EXPECT_NEAR(segment_at(path, 1.5).at(1.5).velocity, 0.0, 1e-12);
}

TEST(Trajectory, GoesOnUntilTheNewOneBeginsAndThenToItsFirstPoint) {
  // 1 rad/s until 1 s; the new one begins at 0.5 s, with a point at 1.5 s.
  JointPath path = resting_path(0.0, 0.0);
  path = spliced_path(path, 0.0, 0.0, {{1.0, {1.0, {}, {}}}}, false, 1, {});
  path = spliced_path(path, 0.1, 0.5, {{1.5, {2.5, {}, {}}}, {2.5, {2.5, {}, {}}}}, false, 2, {});
  ASSERT_EQ(path.size(), 3u);  // segments that end before 0.1 s are dropped
  EXPECT_EQ(path[0].goal, 1u);
  EXPECT_EQ(path[1].goal, 2u);
  EXPECT_NEAR(segment_at(path, 0.4).at(0.4).position, 0.4, 1e-12);
  expect_motion(segment_at(path, 1.0).at(1.0), 1.5, 2.0, 0.0);
  expect_motion(segment_at(path, 2.0).at(2.0), 2.5, 0.0, 0.0);
}

TEST(Trajectory, TurnsToTheNearestOfAContinuousJoint) {
  const auto end_of = [](double from, double to, bool is_wrapping) {
    const JointPath path =
        spliced_path(resting_path(0.0, from), 0.0, 0.0, {{1.0, {to, {}, {}}}}, is_wrapping, 0, {});
    return path.back().at(1.0).position;
  };
  EXPECT_NEAR(end_of(6.2, 0.1, true), 0.1 + 2.0 * kPi, 1e-12);
  EXPECT_NEAR(end_of(-6.2, 0.1, true), 0.1 - 2.0 * kPi, 1e-12);
  EXPECT_NEAR(end_of(6.2, 0.1, false), 0.1, 1e-12);
  EXPECT_NEAR(end_of(0.0, kPi, true), kPi, 1e-12);  // half a turn: the numbers' direction
  EXPECT_NEAR(end_of(0.0, -kPi, true), -kPi, 1e-12);
}

TEST(Trajectory, RefusesPointsThatAreNone) {
  const auto refusal = [](const std::vector<JointTrajectoryPoint>& points) {
    return message_of([&] { check_points(points, 1); });
  };
  EXPECT_EQ(refusal({{{1.0}, {}, {}, {}, 0.5}, {{1.0}, {0.0}, {0.0}, {}, 0.6}}), "no error");
  EXPECT_EQ(refusal({{{}, {1.0}, {}, {}, 0.5}}),
            "points[0].positions: found 0 numbers, expected 1, one a joint");
  EXPECT_EQ(refusal({{{1.0}, {1.0, 2.0}, {}, {}, 0.5}}),
            "points[0].velocities: found 2 numbers, expected 1, one a joint");
  EXPECT_EQ(refusal({{{std::numeric_limits<double>::quiet_NaN()}, {}, {}, {}, 0.5}}),
            "points[0].positions: found a number that is not finite");
  EXPECT_EQ(refusal({{{1.0}, {}, {}, {}, 0.5}, {{1.0}, {}, {}, {}, 0.5}}),
            "points[1].time_from_start: found 0.500000 s, expected more than that of the point "
            "before, 0.500000 s");
}

}  // namespace
}  // namespace ardee::control
