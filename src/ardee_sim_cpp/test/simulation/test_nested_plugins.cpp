// SPDX-License-Identifier: MIT
// Tests that plugins of a nested model name its links and joints without its name.
#include <gtest/gtest.h>

#include <algorithm>

#include "motion_rig.h"

namespace ardee {
using namespace devices;
namespace {

/// Returns two links and a hinge between them, as a model "arm" within the robot's own link and
/// joint of the same names, 1 m above.
std::string robot_with_arm(const std::string& plugins) {
  const std::string parts =
      "<link name='imu'/><link name='hand'/><joint name='wrist' type='revolute'>"
      "<parent>imu</parent><child>hand</child><axis><xyz>0 0 1</xyz></axis></joint>";
  return "<sdf version='1.9'><model name='r'>" + parts +
         "<model name='arm'><pose>0 0 1 0 0 0</pose>" + parts + plugins + "</model></model></sdf>";
}

std::vector<std::string> topics(const Entity& robot) {
  std::vector<std::string> found;
  for (const auto& device : robot.devices) {
    for (const Output& output : device->ports().all<Output>()) found.push_back(output.topic);
  }
  return found;
}

TEST(NestedPlugins, FindTheirOwnLinksAndKeepTheirTopics) {
  TestWorld world(free_space(0.0));
  const Entity& robot =
      world.spawn(robot_with_arm(plugin("gazebo_ros_p3d",
                                        "<bodyName>imu</bodyName><topicName>imu</topicName>")),
                  "r");
  EXPECT_EQ(topics(robot), std::vector<std::string>{"/imu"});
  world.run(0.002);
  const auto readings = world.recorder().on<OdometryReading>("/imu");
  ASSERT_FALSE(readings.empty());
  EXPECT_NEAR(readings.back().pose.p.z(), 1.0, 1e-9);
}

TEST(NestedPlugins, FindTheirOwnJointsInAList) {
  for (const std::string& publisher :
       {plugin("gazebo_ros_joint_state_publisher",
               "<robotNamespace/><jointName>wrist, wrist</jointName>"),
        plugin("gz-sim-joint-state-publisher-system", "")}) {
    TestWorld world(free_space(0.0));
    world.spawn(robot_with_arm(publisher), "r");
    world.run(0.05);
    const auto readings = world.recorder().on<JointStateReading>("/joint_states");
    ASSERT_FALSE(readings.empty());
    const auto& names = readings.back().names;
    EXPECT_TRUE(std::all_of(names.begin(), names.end(),
                            [](const std::string& name) { return name == "arm::wrist"; }));
  }
}

}  // namespace
}  // namespace ardee
