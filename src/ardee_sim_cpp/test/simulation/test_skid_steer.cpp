// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ardee_sim/devices/skid_steer_drive.h"
#include "fixture.h"
#include "rover.h"

namespace ardee {
using namespace devices;
namespace {

const Pose kOnWheels = Pose::from_xyz_rpy({0, 0, 0.151}, {0, 0, 0});

class SkidSteerAtStep : public testing::TestWithParam<double> {};

TEST_P(SkidSteerAtStep, DrivesStraightAtTheCommandedSpeed) {
  TestWorld world(ground_plane(), GetParam());
  Entity& robot = world.spawn(rover(), "rover", kOnWheels);
  world.run(1.0);
  world.command(robot, 0.5, 0.0);
  world.run(1.0);  // picks up speed
  const Eigen::Vector3d start = world->state("rover", "").pose.p;
  world.run(4.0);
  const Pose end = world->state("rover", "").pose;
  EXPECT_NEAR(end.p.x() - start.x(), 2.0, 0.02);  // v t, within 1 %
  EXPECT_NEAR(end.p.y(), 0.0, 0.01);
  EXPECT_NEAR(rpy_from_quaternion(end.q).z(), 0.0, 0.01);
}

TEST_P(SkidSteerAtStep, TurnsLeftForPositiveYawRateButSlowerThanIdealWheelsWould) {
  TestWorld world(ground_plane(), GetParam());
  Entity& robot = world.spawn(rover(), "rover", kOnWheels);
  world.run(0.5);
  world.command(robot, 0.0, 1.0);
  world.run(2.0);
  const double rate = world->state("rover", "").twist.angular.z();
  // Wheels at (+-a, +-b) with rims at the commanded speed slide by (w - w0) b along and w a across.
  // Under Coulomb's friction of equal loads the moments cancel at (w - w0) b^2 + w a^2 = 0.
  constexpr double kA = 0.15, kB = kRoverSeparation_m / 2.0;
  EXPECT_NEAR(rate, kB * kB / (kA * kA + kB * kB), 0.03);
}

INSTANTIATE_TEST_SUITE_P(Steps, SkidSteerAtStep, testing::Values(0.001, 0.005));

TEST(SkidSteer, SideSpeedsFollowTheStockFormula) {
  SkidSteerDrive::Params params;
  params.wheel_separation_m = 0.4;
  params.wheel_diameter_m = 0.2;
  const Twist command{{0.5, 0, 0}, {0, 0, 1.0}};
  EXPECT_DOUBLE_EQ(SkidSteerDrive::side_speed(params, command, true), (0.5 - 0.2) / 0.1);
  EXPECT_DOUBLE_EQ(SkidSteerDrive::side_speed(params, command, false), (0.5 + 0.2) / 0.1);
}

TEST(SkidSteer, OdometryIsTheTruthInTheWorldAndTheTwistIsTheBodys) {
  TestWorld world(ground_plane());
  Entity& robot = world.spawn(rover("<broadcastTF>true</broadcastTF>"), "rover",
                              Pose::from_xyz_rpy({3, 4, 0.151}, {0, 0, M_PI / 2}));
  world.run(0.5);
  world.command(robot, 0.5, 0.0);
  world.run(1.5);
  const auto odometry = world.recorder().on<OdometryReading>("/odom");
  const auto transforms = world.recorder().on<TransformReading>("/tf");
  ASSERT_EQ(odometry.size(), 100u);  // 50 Hz
  ASSERT_EQ(transforms.size(), 100u);
  const OdometryReading& last = odometry.back();
  const Pose truth = world->state("rover", "").pose;
  EXPECT_EQ(last.header.frame_id, "odom");
  EXPECT_EQ(last.child_frame_id, "base");
  EXPECT_EQ(last.pose.p.head<2>(), truth.p.head<2>());
  EXPECT_EQ(last.pose.p.z(), 0.0);
  EXPECT_EQ(transforms.back().pose.p, truth.p);
  EXPECT_NEAR(last.twist.linear.x(), 0.5, 0.01);
  EXPECT_NEAR(last.twist.linear.y(), 0.0, 0.01);
  const std::array<double, 6> stock = {1e-4, 1e-4, 1e12, 1e12, 1e12, 0.01};
  EXPECT_EQ(last.pose_covariance, stock);
  EXPECT_EQ(last.twist_covariance, stock);
  EXPECT_TRUE(transforms.back().in_odometry_frame);
}

TEST(SkidSteer, EncoderOdometryStartsAtZeroAndFollowsTheWheels) {
  TestWorld world(ground_plane());
  Entity& robot = world.spawn(rover("<odometrySource>encoder</odometrySource>"), "rover",
                              Pose::from_xyz_rpy({3, 4, 0.151}, {0, 0, M_PI / 2}));
  world.run(0.5);
  world.command(robot, 0.5, 0.0);
  world.run(3.0);
  const OdometryReading last = world.recorder().on<OdometryReading>("/odom").back();
  const Pose truth = world->state("rover", "").pose;
  EXPECT_NEAR(last.pose.p.x(), truth.p.y() - 4.0, 0.03);
  EXPECT_NEAR(last.pose.p.y(), 0.0, 0.01);
}

TEST(SkidSteer, TheLastCommandStaysUnlessATimeoutIsSet) {
  for (const bool timeout : {false, true}) {
    TestWorld world(ground_plane());
    Entity& robot = world.spawn(rover(timeout ? "<commandTimeout>0.5</commandTimeout>" : ""),
                                "rover", kOnWheels);
    world.run(0.2);
    world.command(robot, 0.5, 0.0);
    world.run(3.0);
    EXPECT_NEAR(world->state("rover", "").twist.linear.x(), timeout ? 0.0 : 0.5, 0.02);
  }
}

TEST(SkidSteer, AStaticRobotStandsThereWithoutItsDrive) {
  TestWorld world("");
  const Entity& robot = world.spawn(rover("", "<gazebo><static>true</static></gazebo>"), "statue");
  EXPECT_TRUE(robot.is_static());
  EXPECT_TRUE(robot.devices.empty());
  EXPECT_TRUE(
      std::any_of(world.messages().begin(), world.messages().end(), [](const std::string& text) {
        return text.find("plugin 'drive' (libgazebo_ros_skid_steer_drive.so) is left out") !=
               std::string::npos;
      }));
  world.run(0.1);
}

TEST(SkidSteer, AnAbsurdCommandDoesNotStopTheWorld) {
  TestWorld world("");
  Entity& robot = world.spawn(rover(), "rover", kOnWheels);
  world.command(robot, 1e300, -1e300);
  EXPECT_NO_THROW(world.run(0.1));
  EXPECT_EQ(world->step_count(), 100u);
}

TEST(SkidSteer, AResetForgetsTheCommand) {
  TestWorld world(ground_plane());
  Entity& robot = world.spawn(rover(), "rover", kOnWheels);
  world.command(robot, 0.5, 0.0);
  world.run(1.0);
  world->reset_world();
  world.run(1.0);
  EXPECT_NEAR(world->state("rover", "").pose.p.x(), 0.0, 1e-3);
}

TEST(SkidSteer, TopicsGoBelowTheNamespaceOfTheSpawnAndTheirOwnIsStronger) {
  TestWorld world(ground_plane());
  Entity& spawned = world.spawn(rover(), "a", kOnWheels, "robot2");
  EXPECT_EQ(spawned.devices[0]->ports().all<Output>()[0].get().topic, "/robot2/odom");
  EXPECT_EQ(spawned.devices[0]->ports().all<Input>()[0].get().topic, "/robot2/cmd_vel");
  Entity& own = world.spawn(rover("<robotNamespace>/mine</robotNamespace>"), "b",
                            Pose::from_xyz_rpy({5, 0, 0.151}, {0, 0, 0}), "robot2");
  EXPECT_EQ(own.devices[0]->ports().all<Output>()[0].get().topic, "/mine/odom");
}

TEST(JointStates, FollowTheWheelsAndAreNamedBelowTheModel) {
  TestWorld world(ground_plane());
  const std::string publisher =
      "<gazebo><plugin name='js' filename='libgazebo_ros_joint_state_publisher.so'>"
      "<jointName>fl_joint, rr_joint</jointName><updateRate>100</updateRate></plugin></gazebo>";
  Entity& robot = world.spawn(rover("", publisher), "rover", kOnWheels);
  world.run(0.5);
  world.command(robot, 0.5, 0.0);
  world.run(2.5);
  const auto states = world.recorder().on<JointStateReading>("/rover/joint_states");
  ASSERT_EQ(states.size(), 300u);
  const JointStateReading& last = states.back();
  ASSERT_EQ(last.names, (std::vector<std::string>{"fl_joint", "rr_joint"}));
  // The wheels roll without slip: angle = path / radius, speed = v / r.
  EXPECT_NEAR(last.positions[0], world->state("rover", "").pose.p.x() / kRoverRadius_m, 0.3);
  EXPECT_NEAR(last.velocities[1], 0.5 / kRoverRadius_m, 0.05);
}

}  // namespace
}  // namespace ardee
