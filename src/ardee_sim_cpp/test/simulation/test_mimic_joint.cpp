// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "motion_rig.h"

namespace ardee {
using namespace devices;
namespace {

/// Returns two wheels of 0.1 kg m^2 on a post, with a plugin.
std::string post(const std::string& keys, const std::string& file) {
  const auto wheel = [](const std::string& name) {
    return "<link name='" + name +
           "'><inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia>"
           "</inertial></link><joint name='j" +
           name + "' type='revolute'><parent>post</parent><child>" + name +
           "</child><axis><xyz>0 0 1</xyz></axis></joint>";
  };
  return "<sdf version='1.6'><model name='post'><link name='post'/><joint name='foot' "
         "type='fixed'><parent>world</parent><child>post</child></joint>" +
         wheel("a") + wheel("b") + "<plugin name='mimic' filename='" + file + "'>" + keys +
         "</plugin></model></sdf>";
}

constexpr const char* kRobotics = "libroboticsgroup_gazebo_mimic_joint_plugin.so";
constexpr const char* kNames = "<joint>ja</joint><mimicJoint>jb</mimicJoint>";

double angle(const Entity& robot, const std::string& joint) {
  return robot.robot->dynamics().joint_position(robot.robot->joint_index(joint, {}));
}

double rate(const Entity& robot, const std::string& joint) {
  return robot.robot->dynamics().joint_velocity(robot.robot->joint_index(joint, {}));
}

TEST(MimicJoint, FollowsWithAnOffsetAlsoAfterAReset) {
  for (const char* file : {kRobotics, "libgazebo_mimic_joint_plugin.so"}) {
    TestWorld world(free_space(0.0));
    Entity& robot = world.spawn(
        post(std::string(kNames) + "<multiplier>-2</multiplier><offset>0.1</offset>", file),
        "post");
    const std::size_t leader = robot.robot->joint_index("ja", {});
    for (int times = 0; times < 2; ++times) {
      robot.robot->dynamics().set_joint_motor(leader, 1.0, 100.0);
      world.run(1.0);
      EXPECT_NEAR(angle(robot, "ja"), 1.0, 2e-3);
      EXPECT_NEAR(angle(robot, "jb"), -2.0 * angle(robot, "ja") + 0.1, 1e-5);
      world->reset_simulation();
    }
  }
}

TEST(MimicJoint, IsPlacedWithItsLeaderWhichStays) {
  TestWorld world(free_space(0.0));
  Entity& robot = world.spawn(
      post("<joint>post::ja</joint><mimicJoint>post::jb</mimicJoint><multiplier>-2</multiplier>"
           "<offset>0.1</offset>",
           kRobotics),
      "post");
  EXPECT_NEAR(angle(robot, "jb"), 0.1, 1e-12);
  robot.robot->dynamics().set_joint_position(robot.robot->joint_index("ja", {}), 0.5);
  EXPECT_NEAR(angle(robot, "jb"), -0.9, 1e-12);
  world.run(1.0);
  EXPECT_NEAR(angle(robot, "ja"), 0.5, 1e-9);
  robot.robot->dynamics().set_joint_position(robot.robot->joint_index("jb", {}), 2.0);
  EXPECT_NEAR(angle(robot, "jb"), -0.9, 1e-9);
}

TEST(MimicJoint, AnEffortBoundsTheFollowerOfAPid) {
  // A torque of 0.2 N m acts on 0.1 kg m^2 for 0.5 s.
  TestWorld world(free_space(0.0));
  Entity& robot = world.spawn(
      post(std::string(kNames) + "<hasPID/><maxEffort>0.2</maxEffort>", kRobotics), "post");
  robot.robot->dynamics().set_joint_motor(robot.robot->joint_index("ja", {}), 10.0, 1000.0);
  world.run(0.5);
  EXPECT_NEAR(rate(robot, "ja"), 10.0, 1e-3);
  EXPECT_NEAR(rate(robot, "jb"), 1.0, 1e-2);
}

TEST(MimicJoint, AJointThatIsNotThereRefusesTheRobot) {
  TestWorld world(free_space(0.0));
  EXPECT_THROW(world.spawn(post("<joint>ja</joint><mimicJoint>jc</mimicJoint>", kRobotics), "post"),
               Error);
}

}  // namespace
}  // namespace ardee
