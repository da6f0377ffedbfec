// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/planar_odometry.h"
#include "rig.h"

namespace ardee::control {
namespace {

TEST(PlanarOdometry, FollowsAnArcExactlyInOneStep) {
  PlanarOdometry odometry(1);
  odometry.start(0);
  odometry.add_way({kPi, 0.0, kPi / 2.0}, 1'000'000'000);  // a quarter of a circle of 2 m
  EXPECT_NEAR(odometry.pose().p.x(), 2.0, 1e-12);
  EXPECT_NEAR(odometry.pose().p.y(), 2.0, 1e-12);
  EXPECT_NEAR(rpy_from_quaternion(odometry.pose().q).z(), kPi / 2.0, 1e-12);
  EXPECT_NEAR(odometry.twist().linear.x(), kPi, 1e-12);
  EXPECT_NEAR(odometry.twist().angular.z(), kPi / 2.0, 1e-12);
}

TEST(PlanarOdometry, MovesSidewaysOnAnArcToo) {
  PlanarOdometry odometry(1);
  odometry.start(0);
  odometry.add_velocity({0.0, kPi / 2.0, kPi / 2.0}, 1'000'000'000);  // facing outwards, 1 m
  EXPECT_NEAR(odometry.pose().p.x(), -1.0, 1e-12);
  EXPECT_NEAR(odometry.pose().p.y(), 1.0, 1e-12);
  EXPECT_NEAR(odometry.twist().linear.y(), kPi / 2.0, 1e-12);
}

TEST(PlanarOdometry, GoesStraightWhereAnArcHasNoCentre) {
  PlanarOdometry odometry(1);
  odometry.start(0);
  odometry.add_way({3.0, 0.0, 1e-9}, 1'000'000'000);
  EXPECT_NEAR(odometry.pose().p.x(), 3.0, 1e-12);
  EXPECT_NEAR(odometry.pose().p.y(), 1.5e-9, 1e-15);
}

TEST(PlanarOdometry, GivesTheMeanVelocityOfItsWindow) {
  PlanarOdometry odometry(3);
  odometry.start(0);
  TimeNs now_ns = 0;
  const auto after = [&](double way_m) {
    now_ns += 100'000'000;
    odometry.add_way({way_m, 0.0, 0.0}, now_ns);
    return odometry.twist().linear.x();
  };
  EXPECT_NEAR(after(0.1), 1.0, 1e-12);
  EXPECT_NEAR(after(0.3), 2.0, 1e-12);
  EXPECT_NEAR(after(0.5), 3.0, 1e-12);
  EXPECT_NEAR(after(0.7), 5.0, 1e-12);  // the mean of 3, 5, 7
}

TEST(PlanarOdometry, KeepsItsPoseAtAStartAndLosesItAtAReset) {
  PlanarOdometry odometry(3);
  odometry.start(0);
  odometry.add_way({1.0, 0.0, 0.0}, 1'000'000'000);
  odometry.start(1'000'000'000);
  EXPECT_EQ(odometry.pose().p.x(), 1.0);
  odometry.add_way({2.0, 0.0, 0.0}, 2'000'000'000);
  EXPECT_EQ(odometry.twist().linear.x(), 2.0);  // not the mean of 1 and 2
  odometry.reset(0);
  EXPECT_EQ(odometry.pose().p.x(), 0.0);
  EXPECT_EQ(odometry.twist().linear.x(), 0.0);
}

TEST(PlanarOdometry, TakesNoVelocityFromTimesThatAreTooShort) {
  PlanarOdometry odometry(1);
  odometry.start(0);
  odometry.add_way({1.0, 0.0, 0.0}, 50'000);
  EXPECT_EQ(odometry.pose().p.x(), 1.0);
  EXPECT_EQ(odometry.twist().linear.x(), 0.0);
}

}  // namespace
}  // namespace ardee::control
