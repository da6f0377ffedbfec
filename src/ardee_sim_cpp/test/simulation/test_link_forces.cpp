// SPDX-License-Identifier: MIT
// Tests of libgazebo_ros_f3d.so and libgazebo_ros_force.so.
#include <gtest/gtest.h>

#include "fixture.h"

namespace ardee {
using namespace physics;
using namespace devices;
namespace {

/// Returns a cube of 2 kg and 0.2 m that slides without friction; its centre of mass is 0.05 m up.
std::string cube(const std::string& plugin) {
  return "<sdf version='1.7'><model name='cube'><link name='body'><inertial>"
         "<pose>0 0 0.05 0 0 0</pose><mass>2</mass><inertia><ixx>0.02</ixx><iyy>0.02</iyy>"
         "<izz>0.02</izz></inertia></inertial><collision name='c'><geometry><box><size>0.2 0.2 0.2"
         "</size></box></geometry><surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction>"
         "</surface></collision></link>" +
         plugin + "</model></sdf>";
}

std::string plugin(const std::string& name) {
  return "<plugin name='p' filename='libgazebo_ros_" + name +
         ".so'><bodyName>body</bodyName><topicName>wrench</topicName></plugin>";
}

TEST(LinkForce, IsWhatTheGroundCarries) {
  TestWorld world(ground_plane());
  world.spawn(cube(plugin("f3d")), "cube", Pose::from_xyz_rpy({0, 0, 0.1}, {0, 0, 0}));
  world.run(1.0);
  const auto readings = world.recorder().on<WrenchReading>("/wrench");
  ASSERT_EQ(readings.size(), 1000u);  // each step
  EXPECT_EQ(readings.back().header.frame_id, "world");
  EXPECT_NEAR(readings.back().wrench.force.z(), 2.0 * 9.8, 1e-3);
  EXPECT_LT(readings.back().wrench.torque.norm(), 1e-3);
}

TEST(LinkPush, AcceleratesByForceOverMassAndTorqueOverInertia) {
  TestWorld world("<gravity>0 0 0</gravity>");
  Entity& robot = world.spawn(cube(plugin("force")), "cube");
  const Input& input = robot.devices.at(0)->ports().all<Input>().at(0);
  EXPECT_EQ(input.topic, "/wrench");
  input.on_command(ForceTorque{{4, 0, 0}, {0, 0, 0.01}});
  world.run(0.5);
  // The force passes through the centre of mass: only the torque turns it, by 0.01 / 0.02 rad/s^2.
  const Twist twist = world->state("cube", "").twist;
  EXPECT_NEAR(twist.linear.x(), 4.0 / 2.0 * 0.5, 1e-9);
  EXPECT_NEAR(twist.angular.z(), 0.25, 1e-9);
  EXPECT_NEAR(twist.angular.y(), 0.0, 1e-9);
  input.on_command(ForceTorque{});
  world.run(0.5);
  EXPECT_NEAR(world->state("cube", "").twist.linear.x(), 1.0, 1e-9);
}

TEST(LinkPush, IsForgottenByAReset) {
  TestWorld world("<gravity>0 0 0</gravity>");
  Entity& robot = world.spawn(cube(plugin("force")), "cube");
  robot.devices.at(0)->ports().all<Input>().at(0).get().on_command(
      ForceTorque{{4, 0, 0}, {0, 0, 0}});
  world.run(0.1);
  world->reset_world();
  world.run(0.1);
  EXPECT_EQ(world->state("cube", "").twist.linear.x(), 0.0);
}

}  // namespace
}  // namespace ardee
