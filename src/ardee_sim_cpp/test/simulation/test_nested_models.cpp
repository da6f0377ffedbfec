// SPDX-License-Identifier: MIT
// Tests models within models: their plugins name their links and joints without the model's name,
// and services find them by "model::nested".
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

/// Returns a base with an arm fixed 1 m ahead and a grip on the arm, both models within it.
std::string robot_with_parts() {
  return R"(<sdf version='1.9'><model name='r'>
  <link name='base'/>
  <model name='arm'>
    <pose>1 0 0.5 0 0 0</pose>
    <link name='hand'><pose>0 0 0.2 0 0 0</pose></link>
    <model name='grip'><pose>1 0 0 0 0 0</pose><link name='finger'/></model>
    <joint name='wrist' type='fixed'><parent>hand</parent><child>grip::finger</child></joint>
  </model>
  <joint name='shoulder' type='fixed'><parent>base</parent><child>arm::hand</child></joint>
</model></sdf>)";
}

TEST(NestedModels, HavePosesAndVelocitiesOfTheirOwn) {
  TestWorld world(free_space(0.0));
  world.spawn(robot_with_parts(), "r");
  world->set_state("r", {Pose::from_xyz_rpy({0, 0, 0}, {0, 0, M_PI_2}), {{}, {0, 0, 2}}}, "");
  const RelativeState arm = world->state("r::arm", "");
  EXPECT_TRUE(arm.pose.p.isApprox(Eigen::Vector3d(0, 1, 0.5), 1e-9));
  EXPECT_TRUE(arm.twist.linear.isApprox(Eigen::Vector3d(-2, 0, 0), 1e-9));
  EXPECT_TRUE(arm.twist.angular.isApprox(Eigen::Vector3d(0, 0, 2), 1e-9));
  EXPECT_TRUE(world->state("r::arm::grip", "r").pose.p.isApprox(Eigen::Vector3d(2, 0, 0.5), 1e-9));
  EXPECT_THROW(world->state("r::leg", ""), Error);
}

TEST(NestedModels, StandWithinAStaticModel) {
  TestWorld world(free_space(0.0));
  world.spawn(
      "<sdf version='1.9'><model name='yard'><static>1</static><model name='box'><pose>0 3 0 0 0 0"
      "</pose><link name='lid'/></model></model></sdf>",
      "yard");
  world->set_state("yard::box", {Pose::from_xyz_rpy({1, 0, 0}, {0, 0, 0}), {}}, "");
  EXPECT_TRUE(world->state("yard", "").pose.p.isApprox(Eigen::Vector3d(1, -3, 0), 1e-9));
}

TEST(NestedModels, MoveWithTheirWholeModel) {
  TestWorld world(free_space(0.0));
  world.spawn(robot_with_parts(), "r");
  const RelativeState wanted{Pose::from_xyz_rpy({5, 0, 1}, {0, 0, 0}), {{}, {0, 0, 1}}};
  for (const char* name : {"r::arm", "r::arm::hand"}) {
    world->set_state(name, wanted, "");
    const RelativeState base = world->state("r", "");
    const double up_m = std::string(name) == "r::arm" ? 0.5 : 0.3;
    EXPECT_TRUE(base.pose.p.isApprox(Eigen::Vector3d(4, 0, up_m), 1e-9)) << name;
    EXPECT_TRUE(base.twist.linear.isApprox(Eigen::Vector3d(0, -1, 0), 1e-9)) << name;
  }
}

}  // namespace
}  // namespace ardee
