// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "fixture.h"

namespace ardee {
using namespace devices;
namespace {

/// Returns a box in the air, by default without weight.
std::string mover(const std::string& keys, bool gravity = false) {
  return "<robot name='mover'><link name='base'><inertial><mass value='4'/>"
         "<inertia ixx='0.05' ixy='0' ixz='0' iyy='0.08' iyz='0' izz='0.1'/></inertial>"
         "<collision><geometry><box size='0.4 0.4 0.2'/></geometry></collision></link>"
         "<gazebo reference='base'><mu1>0</mu1><mu2>0</mu2><gravity>" +
         std::string(gravity ? "true" : "false") +
         "</gravity></gazebo><gazebo><plugin name='move' filename='libgazebo_ros_planar_move.so'>" +
         keys + "</plugin></gazebo></robot>";
}

void command(Entity& robot, const Eigen::Vector3d& linear, double turn_rad_per_s) {
  for (const auto& device : robot.devices) {
    for (Input& input : device->ports().all<Input>())
      input.on_command(Twist{linear, {0, 0, turn_rad_per_s}});
  }
}

TEST(PlanarMove, MovesAlongAndAcrossItsHeading) {
  TestWorld world("");
  Entity& robot = world.spawn(mover(""), "mover", Pose::from_xyz_rpy({1, 2, 3}, {0, 0, M_PI / 2}));
  command(robot, {0.5, 0.25, 7.0}, 0.0);
  world.run(2.0);
  // Its x is the world's y, its y the world's -x; it ignores heights.
  const Pose end = world->state("mover", "").pose;
  EXPECT_NEAR(end.p.x(), 1 - 0.5, 1e-9);
  EXPECT_NEAR(end.p.y(), 2 + 1.0, 1e-9);
  EXPECT_NEAR(end.p.z(), 3, 1e-9);
}

TEST(PlanarMove, TurnsInACircleOfSpeedOverYawRate) {
  TestWorld world("");
  Entity& robot = world.spawn(mover(""), "mover");
  command(robot, {0.5, 0, 0}, 0.5);
  world.run(M_PI / 0.5);
  const Pose end = world->state("mover", "").pose;
  EXPECT_NEAR(end.p.y(), 2.0, 1e-3);  // diameter = 2 v / w
  EXPECT_NEAR(end.p.x(), 0.0, 2e-3);
  EXPECT_NEAR(world->state("mover", "").twist.angular.z(), 0.5, 1e-9);
}

TEST(PlanarMove, FallsAndLandsAsItMoves) {
  TestWorld world(ground_plane());
  Entity& robot = world.spawn(mover("", true), "mover", Pose::from_xyz_rpy({0, 0, 1}, {0, 0, 0}));
  command(robot, {1, 0, 0}, 0.0);
  world.run(0.3);
  EXPECT_NEAR(world->state("mover", "").pose.p.z(), 1 - 0.5 * 9.8 * 0.09, 5e-3);
  world.run(1.7);
  EXPECT_NEAR(world->state("mover", "").pose.p.z(), 0.1, 5e-3);
  EXPECT_NEAR(world->state("mover", "").pose.p.x(), 2.0, 5e-3);
}

TEST(PlanarMove, SaysWhereItIsAtItsRate) {
  TestWorld world("");
  Entity& robot =
      world.spawn(mover("<odometryTopic>where</odometryTopic><odometryFrame>start</odometryFrame>"
                        "<odometryRate>50</odometryRate><robotBaseFrame>base</robotBaseFrame>"),
                  "mover", Pose::from_xyz_rpy({3, 4, 5}, {0, 0, M_PI / 2}), "/r1");
  command(robot, {0.5, 0.1, 0}, 0.2);
  world.run(1.0);
  const auto readings = world.recorder().on<OdometryReading>("/r1/where");
  ASSERT_EQ(readings.size(), 50u);
  const OdometryReading& last = readings.back();
  EXPECT_EQ(last.header.frame_id, "start");
  EXPECT_EQ(last.child_frame_id, "base");
  EXPECT_NEAR(last.pose.p.z(), 5, 1e-9);
  EXPECT_NEAR(last.twist.linear.x(), 0.5, 1e-3);
  EXPECT_NEAR(last.twist.linear.y(), 0.1, 1e-3);
  EXPECT_NEAR(last.twist.angular.z(), 0.2, 1e-9);
  const auto transforms = world.recorder().on<TransformReading>("/tf");
  EXPECT_EQ(transforms.size(), 50u);
  EXPECT_TRUE(transforms.back().in_odometry_frame);
}

TEST(PlanarMove, TellsNothingAtARateThatIsNotAboveZero) {
  for (const char* rate_hz : {"0", "-1"}) {
    TestWorld world("");
    world.spawn(mover(std::string("<odometryRate>") + rate_hz + "</odometryRate>"), "mover");
    world.run(1.0);
    EXPECT_TRUE(world.recorder().on<OdometryReading>("/odom").empty()) << rate_hz;
  }
}

TEST(PlanarMove, ACommandLastsUntilItsTimeoutOrForEver) {
  for (const auto& [keys, way_m] :
       {std::pair("<cmdTimeout>0.5</cmdTimeout>", 0.5),
        std::pair("<cmdTimeout>-1</cmdTimeout>", 2.0), std::pair("", 2.0)}) {
    TestWorld world("");
    command(world.spawn(mover(keys), "mover"), {1, 0, 0}, 0.0);
    world.run(2.0);
    EXPECT_NEAR(world->state("mover", "").pose.p.x(), way_m, 3e-3) << keys;
  }
}

TEST(PlanarMove, AnAbsurdCommandIsCutToWhatStaysInTheWorld) {
  TestWorld world("");
  command(world.spawn(mover(""), "mover"), {1e300, 0, 0}, -1e300);
  world.run(0.1);
  EXPECT_TRUE(world.messages().empty()) << "it is not put back: " << world.messages()[0];
  const RelativeState end = world->state("mover", "");
  EXPECT_NEAR(end.twist.linear.norm(), 1e3, 1e-6);
  EXPECT_NEAR(end.twist.angular.z(), -1e3, 1e-6);
  // The legs of 1 m, each turned by 1 rad, are sides of a polygon of radius 1 / (2 sin 0.5).
  EXPECT_LT(end.pose.p.norm(), 1.0 / std::sin(0.5));
}

}  // namespace
}  // namespace ardee
