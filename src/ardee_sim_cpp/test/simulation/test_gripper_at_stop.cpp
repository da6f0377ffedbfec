// SPDX-License-Identifier: MIT
// Tests of a gripper of ros_control whose goal lies beyond the stop of its finger.
#include "../controllers/recorded_goal.h"
#include "ardee_sim/controllers/ros_control.h"
#include "fixture.h"

namespace ardee {
using namespace devices;
namespace {

using control::RecordedGoal;

constexpr double kStop_m = 0.05;
constexpr double kEffort_n = 20.0;

/// Returns a finger of 1 kg on a post in the world, without damping; it slides along x up to a
/// stop.
std::string finger() {
  const std::string inertial =
      "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"
      "</inertial>";
  return "<robot name='gripper'><link name='world'/><link name='post'>" + inertial +
         "</link><link name='tip'>" + inertial +
         "</link><joint name='foot' type='fixed'><parent link='world'/><child link='post'/></joint>"
         "<joint name='finger' type='prismatic'><parent link='post'/><child link='tip'/>"
         "<axis xyz='1 0 0'/><limit lower='0' upper='0.05' effort='100' velocity='5'/></joint>"
         "<transmission name='t'><type>T</type><joint name='finger'><hardwareInterface>"
         "EffortJointInterface</hardwareInterface></joint><actuator name='m'/></transmission>"
         "<gazebo><plugin name='control' filename='libgazebo_ros_control.so'/></gazebo></robot>";
}

TEST(GripperAtStop, StallsThereWithTheEffortOfItsGoal) {
  SimulationOptions options;
  options.parameter = [](const std::string& name) {
    if (name != "/gripper") return no_parameter(name);
    return control::settings_of(
        {{"type", std::string("effort_controllers/GripperActionController")},
         {"joint", std::string("finger")},
         {"goal_tolerance", 0.002},
         {"stall_timeout", 0.3},
         {"gains/finger/p", 4000.0},
         {"gains/finger/d", 40.0}},
        name);
  };
  TestWorld world("<gravity>0 0 0</gravity>", 0.001, options);
  Entity& robot = world.spawn(finger(), "gripper");
  auto& device = dynamic_cast<control::RosControl&>(*robot.devices.at(0));
  control::Controller& gripper = device.manager().load("gripper");
  device.manager().switch_controllers({{"gripper"}, {}});
  world.run(0.1);
  const auto goal = std::make_shared<RecordedGoal<GripperAction>>();
  std::get<GripperAction>(gripper.ports().all<Action>().at(0).get())
      .on_goal({0.08, kEffort_n}, goal);
  world.run(1.0);
  EXPECT_EQ(goal->state(), "aborted");
  EXPECT_TRUE(goal->result.is_stalled);
  EXPECT_FALSE(goal->result.has_reached_goal);
  EXPECT_NEAR(goal->result.position, kStop_m, 1e-6);
  EXPECT_EQ(goal->result.effort, kEffort_n);
}

}  // namespace
}  // namespace ardee
