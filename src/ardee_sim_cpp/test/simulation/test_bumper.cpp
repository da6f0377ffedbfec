// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "fixture.h"

namespace ardee {
using namespace physics;
using namespace devices;
namespace {

/// Returns a deck of 8 kg that slides with friction 0.2, and a guard fixed before it whose front
/// face is 0.36 m ahead; `sensor` goes into the guard's contact sensor.
std::string mower(const std::string& sensor, const std::string& plugin = "") {
  return "<robot name='mower'><link name='deck'><inertial><mass value='8'/>"
         "<inertia ixx='0.2' iyy='0.3' izz='0.4' ixy='0' ixz='0' iyz='0'/></inertial>"
         "<collision><geometry><box size='0.6 0.4 0.2'/></geometry></collision></link>"
         "<link name='guard'><inertial><mass value='0.2'/>"
         "<inertia ixx='1e-3' iyy='1e-3' izz='1e-3' ixy='0' ixz='0' iyz='0'/></inertial>"
         "<collision><geometry><box size='0.04 0.4 0.1'/></geometry></collision></link>"
         "<joint name='mount' type='fixed'><parent link='deck'/><child link='guard'/>"
         "<origin xyz='0.34 0 0'/></joint>"
         "<gazebo reference='deck'><mu1>0.2</mu1><mu2>0.2</mu2></gazebo>"
         "<gazebo reference='guard'><sensor type='contact' name='touch'>"
         "<update_rate>50</update_rate>" +
         sensor +
         "<plugin name='touch_plugin' filename='libgazebo_ros_bumper.so'>"
         "<bumperTopicName>bumper</bumperTopicName><frameName>guard</frameName>" +
         plugin + "</plugin></sensor></gazebo></robot>";
}

std::string watching(const std::string& collision) {
  return "<contact><collision>" + collision + "</collision></contact>";
}

const std::string kScene = ground_plane() + static_box("box", "1 0 0.5 0 0 0", "1 2 1");

class NamedBumper : public testing::TestWithParam<const char*> {};

TEST_P(NamedBumper, FeelsTheBoxThatItIsPushedAgainst) {
  TestWorld world(kScene);
  Entity& robot =
      world.spawn(mower(watching(GetParam())), "mower", Pose::from_xyz_rpy({0, 0, 0.1}, {0, 0, 0}));
  world->wrenches().add({robot.robot.get(), 0, {40, 0, 0}, {}, {}, 0, -1});
  world.run(2.0);
  const auto messages = world.recorder().on<ContactsReading>("/bumper");
  ASSERT_EQ(messages.size(), 100u);
  EXPECT_TRUE(messages[0].touches.empty());  // 0.14 m away
  EXPECT_EQ(messages[0].header.frame_id, "guard");
  const ContactsReading& last = messages.back();
  ASSERT_EQ(last.touches.size(), 20u);  // one a step of 1 ms
  for (const ContactsReading::Touch& touch : last.touches) {
    EXPECT_EQ(touch.collision1, "mower::guard::guard_collision");
    EXPECT_EQ(touch.collision2, "box::link::c");
    double force = 0.0;
    for (const Contact& point : touch.points) {
      EXPECT_NEAR(point.normal.x(), -1.0, 1e-6);
      EXPECT_NEAR(point.position.x(), 0.5, 0.01);
      force += point.on1.force.x();
    }
    // The push is reduced by friction: 0.2 x 8.2 kg x 9.8 m/s^2 = 16 N, either way at rest.
    EXPECT_LT(force, -(40.0 - 16.08) * 0.98);
    EXPECT_GT(force, -(40.0 + 16.08) * 1.02);
  }
}

INSTANTIATE_TEST_SUITE_P(AsWrittenAndAsGazeboLumpsIt, NamedBumper,
                         testing::Values("guard_collision",
                                         "deck_fixed_joint_lump__guard_collision_1"));

TEST(Bumper, OnSceneryFeelsWhatFallsOnIt) {
  const std::string pad =
      "<model name='pad'><static>true</static><link name='l'><collision name='c'><geometry><box>"
      "<size>1 1 0.2</size></box></geometry></collision><sensor name='s' type='contact'>"
      "<update_rate>10</update_rate><contact><collision>c</collision><topic>touched</topic>"
      "</contact></sensor></link></model>"
      "<model name='ball'><pose>0 0 0.3 0 0 0</pose><link name='l'><inertial><mass>2</mass>"
      "</inertial><collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry>"
      "</collision></link></model>";
  TestWorld world(pad);
  world.run(3.0);
  const auto messages = world.recorder().on<ContactsReading>("/touched");
  ASSERT_FALSE(messages.empty());
  const auto& touches = messages.back().touches;
  ASSERT_EQ(touches.size(), 100u);
  EXPECT_EQ(touches[0].collision1, "pad::l::c");
  EXPECT_EQ(touches[0].collision2, "ball::l::c");
  EXPECT_NEAR(touches[0].points.at(0).on1.force.z(), -2.0 * 9.8, 0.05);
  EXPECT_NEAR(touches[0].points.at(0).normal.z(), -1.0, 1e-6);
}

TEST(Bumper, IsLeftOutWhereItsCollisionIsUnknown) {
  TestWorld world(kScene);
  world.spawn(mower(watching("gard_collision")), "mower");
  ASSERT_FALSE(world.messages().empty());
  EXPECT_NE(world.messages().back().find("found collision 'gard_collision', expected one of: "
                                         "guard_collision, deck_collision"),
            std::string::npos)
      << world.messages().back();
}

}  // namespace
}  // namespace ardee
