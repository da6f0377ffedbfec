// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "ardee_sim/devices/pose_track.h"

namespace ardee {
using namespace devices;
namespace {

Pose at_x(double x_m, double yaw_rad = 0.0) {
  return Pose::from_xyz_rpy({x_m, 0, 0}, {0, 0, yaw_rad});
}

TEST(PoseTrack, GoesStraightAndTurnsEvenlyBetweenPoses) {
  PoseTrack track(1000);
  track.add(0, at_x(0.0));
  track.add(100, at_x(1.0, 1.0));
  const Pose between = track.at(25.0);
  EXPECT_NEAR(between.p.x(), 0.25, 1e-15);
  EXPECT_NEAR(rpy_from_quaternion(between.q).z(), 0.25, 1e-12);
  EXPECT_EQ(track.at(100.0).p.x(), 1.0);
}

TEST(PoseTrack, StandsStillBeforeItsFirstAndAfterItsLastPose) {
  PoseTrack track(1000);
  track.add(100, at_x(1.0));
  track.add(200, at_x(2.0));
  EXPECT_EQ(track.at(0.0).p.x(), 1.0);
  EXPECT_EQ(track.at(300.0).p.x(), 2.0);
}

TEST(PoseTrack, RemembersItsWhileAndNoMore) {
  PoseTrack track(250);
  for (int k = 0; k <= 10; ++k) track.add(100 * k, at_x(k));
  EXPECT_NEAR(track.at(750.0).p.x(), 7.5, 1e-12) << "the whole while, up to its first moment";
  EXPECT_EQ(track.at(0.0).p.x(), 7.0) << "what was before is forgotten";
}

TEST(PoseTrack, APoseAtTheSameTimeReplacesTheLast) {
  PoseTrack track(1000);
  track.add(0, at_x(0.0));
  track.add(100, at_x(1.0));
  track.add(100, at_x(5.0));
  EXPECT_NEAR(track.at(50.0).p.x(), 2.5, 1e-15);
}

}  // namespace
}  // namespace ardee
