// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "fixture.h"
#include "rover.h"

namespace ardee {
using namespace devices;
namespace {

const Pose kOnWheels = Pose::from_xyz_rpy({0, 0, 0.151}, {0, 0, 0});

/// Returns the message of the exception that `call` throws; empty for none.
template <typename Call>
std::string message_of(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Handles, CommandDrivesAndLatestTells) {
  TestWorld world(ground_plane(), 0.005);
  Entity& robot = world.spawn(rover(), "rover", kOnWheels);
  const auto drive = world->command_port<Twist>("cmd_vel");
  const auto odometry = world->reading_port<OdometryReading>("/odom");
  EXPECT_EQ(world->latest(odometry), nullptr);
  for (int k = 0; k < 400; ++k) {
    world->command(drive, Twist{{0.5, 0, 0}, {0, 0, 0}});
    world->step();
  }
  ASSERT_NE(world->latest(odometry), nullptr);
  EXPECT_NEAR(world->latest(odometry)->pose.p.x(), robot.robot->pose().p.x(), 0.02);
  EXPECT_NEAR(world->latest(odometry)->pose.p.x(), 1.0, 0.05);
  EXPECT_EQ(world.recorder().on<OdometryReading>("/odom").back().header.stamp_ns,
            world->latest(odometry)->header.stamp_ns);
  world->reset_simulation();
  EXPECT_EQ(world->latest(odometry), nullptr);
}

TEST(Handles, WhatIsNotThereIsNamedWithWhatIs) {
  TestWorld world(ground_plane(), 0.005);
  world.spawn(rover(), "rover", kOnWheels);
  EXPECT_EQ(message_of([&] { world->command_port<Twist>("cmd"); }),
            "found no topic '/cmd' that takes such commands, expected one of: /cmd_vel");
  EXPECT_NE(message_of([&] { world->command_port<double>("cmd_vel"); }), "");
  EXPECT_EQ(message_of([&] { world->reading_port<LidarReading>("odom"); }),
            "found no topic '/odom' that gives such readings, expected one of: none");
  EXPECT_EQ(world->latest(ReadingPort<LidarReading>()), nullptr);
}

TEST(Handles, GoOnWithARobotThatComesBack) {
  TestWorld world(ground_plane(), 0.005);
  world.spawn(rover(), "rover", kOnWheels);
  const auto drive = world->command_port<Twist>("cmd_vel");
  const auto odometry = world->reading_port<OdometryReading>("odom");
  world->remove("rover");
  EXPECT_NE(message_of([&] { world->command(drive, Twist{}); }), "");
  world.run(0.1);
  world.spawn(rover(), "rover", kOnWheels);
  world->command(drive, Twist{});
  world.run(0.1);
  ASSERT_NE(world->latest(odometry), nullptr);
  EXPECT_GT(world->latest(odometry)->header.stamp_ns, nanoseconds(0.1));
}

}  // namespace
}  // namespace ardee
