// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "fixture.h"

namespace ardee {
using namespace devices;
namespace {

/// Returns a box on two balls as wheels (with one point of contact, so that the track is exact) of
/// radius 0.1 m, 0.4 m apart, and a frictionless ball in front and behind.
std::string two_wheeler(const std::string& keys) {
  std::string xml =
      "<robot name='cart'><link name='base'><inertial><mass value='4'/>"
      "<inertia ixx='0.05' ixy='0' ixz='0' iyy='0.08' iyz='0' izz='0.1'/></inertial>"
      "<collision><origin xyz='0.15 0 -0.047'/><geometry><sphere radius='0.05'/></geometry>"
      "</collision><collision><origin xyz='-0.15 0 -0.047'/><geometry><sphere radius='0.05'/>"
      "</geometry></collision></link><gazebo reference='base'><mu1>0</mu1><mu2>0</mu2></gazebo>";
  for (const auto& [name, y] : {std::pair("left", "0.2"), std::pair("right", "-0.2")}) {
    const std::string wheel = name;
    xml += "<link name='" + wheel +
           "'><inertial><mass value='0.5'/>"
           "<inertia ixx='0.0015' ixy='0' ixz='0' iyy='0.0025' iyz='0' izz='0.0015'/></inertial>"
           "<collision><geometry><sphere radius='0.1'/></geometry></collision></link>"
           "<joint name='" +
           wheel + "_joint' type='continuous'><parent link='base'/><child link='" + wheel +
           "'/><origin xyz='0 " + y + " 0'/><axis xyz='0 1 0'/></joint><gazebo reference='" +
           wheel + "'><mu1>1</mu1><mu2>1</mu2><kp>1e6</kp><kd>100</kd></gazebo>";
  }
  return xml +
         "<gazebo><plugin name='drive' filename='libgazebo_ros_diff_drive.so'>"
         "<wheelSeparation>0.4</wheelSeparation><wheelDiameter>0.2</wheelDiameter>"
         "<wheelTorque>10</wheelTorque><robotBaseFrame>base</robotBaseFrame>" +
         keys + "</plugin></gazebo></robot>";
}

const std::string kModern = "<legacyMode>false</legacyMode>";
const Pose kOnWheels = Pose::from_xyz_rpy({0, 0, 0.101}, {0, 0, 0});

TEST(DiffDrive, DrivesACircleOfSpeedOverYawRate) {
  TestWorld world(ground_plane());
  Entity& robot = world.spawn(two_wheeler(kModern), "cart", kOnWheels);
  world.run(0.5);
  world.command(robot, 0.5, 0.5);
  world.run(0.5 + M_PI / 0.5);  // half a turn, and a little to pick up speed
  const Pose end = world->state("cart", "").pose;
  EXPECT_NEAR(end.p.y(), 2.0, 0.06);  // diameter = 2 v / w
  EXPECT_NEAR(world->state("cart", "").twist.angular.z(), 0.5, 0.02);
}

TEST(DiffDrive, LegacyModeSwapsLeftAndRightAsGazeboDoes) {
  TestWorld world(ground_plane());
  Entity& robot = world.spawn(two_wheeler(""), "cart", kOnWheels);
  EXPECT_TRUE(std::any_of(
      world.messages().begin(), world.messages().end(),
      [](const std::string& text) { return text.find("legacyMode") != std::string::npos; }));
  world.run(0.5);
  world.command(robot, 0.0, 0.5);
  world.run(1.0);
  EXPECT_NEAR(world->state("cart", "").twist.angular.z(), -0.5, 0.02);
}

TEST(DiffDrive, WheelAccelerationLimitsHowFastTheSpeedRises) {
  TestWorld world(ground_plane());
  Entity& robot = world.spawn(two_wheeler(kModern + "<wheelAcceleration>0.25</wheelAcceleration>"),
                              "cart", kOnWheels);
  world.run(0.5);
  world.command(robot, 1.0, 0.0);
  world.run(2.0);
  EXPECT_NEAR(world->state("cart", "").twist.linear.x(), 0.5, 0.02);  // a t
  world.run(3.0);
  EXPECT_NEAR(world->state("cart", "").twist.linear.x(), 1.0, 0.02);
}

TEST(DiffDrive, EncoderOdometryFollowsTheWheelsAndWorldOdometryIsTheTruth) {
  for (const std::string source : {"encoder", "world"}) {
    TestWorld world(ground_plane());
    Entity& robot =
        world.spawn(two_wheeler(kModern + "<odometrySource>" + source + "</odometrySource>"),
                    "cart", Pose::from_xyz_rpy({3, 4, 0.101}, {0, 0, M_PI / 2}));
    world.run(0.5);
    world.command(robot, 0.5, 0.3);
    world.run(3.0);
    const OdometryReading last = world.recorder().on<OdometryReading>("/odom").back();
    const Pose truth = world->state("cart", "").pose;
    const Pose moved = source == "world"
                           ? truth
                           : Pose::from_xyz_rpy({3, 4, 0}, {0, 0, M_PI / 2}).inverse() * truth;
    EXPECT_NEAR(last.pose.p.x(), moved.p.x(), 0.05) << source;
    EXPECT_NEAR(last.pose.p.y(), moved.p.y(), 0.05) << source;
    EXPECT_NEAR(last.twist.linear.x(), 0.5, 0.02) << source;
    EXPECT_NEAR(last.twist.angular.z(), 0.3, 0.02) << source;
    EXPECT_EQ(last.pose_covariance[0], 1e-5);
    EXPECT_EQ(last.twist_covariance, (std::array<double, 6>{})) << "the stock plugin says none";
    EXPECT_TRUE(world.recorder().on<TransformReading>("/tf").back().in_odometry_frame);
  }
}

TEST(DiffDrive, WheelsAreInTheTreeAndTheRightOneIsNamedFirst) {
  TestWorld world(ground_plane());
  world.spawn(two_wheeler(kModern + "<publishWheelTF>true</publishWheelTF><publishOdomTF>false"
                                    "</publishOdomTF><publishWheelJointState>true"
                                    "</publishWheelJointState>"),
              "cart", kOnWheels);
  world.run(0.1);
  const auto states = world.recorder().on<JointStateReading>("/joint_states");
  ASSERT_EQ(states.size(), 10u);
  EXPECT_EQ(states.back().names, (std::vector<std::string>{"right_joint", "left_joint"}));
  const auto transforms = world.recorder().on<TransformReading>("/tf");
  ASSERT_EQ(transforms.size(), 20u);
  EXPECT_EQ(transforms[0].header.frame_id, "base");
  EXPECT_EQ(transforms[0].child_frame_id, "right");
  EXPECT_NEAR(transforms[0].pose.p.y(), -0.2, 1e-4);
  EXPECT_FALSE(transforms[0].in_odometry_frame);
}

}  // namespace
}  // namespace ardee
