// SPDX-License-Identifier: MIT
// Tests that worlds that were saved while they ran continue from there.
#include <gtest/gtest.h>

#include <cmath>

#include "fixture.h"

namespace ardee {
using namespace devices;
namespace {

using Eigen::Vector3d;

/// Returns a gate 1 m up whose leaf hangs on a hinge 5 cm beside its post.
std::string gate(const std::string& name, const std::string& y,
                 const std::string& limits = "<lower>-1.7</lower><upper>1.7</upper>") {
  return "<model name='" + name + "'><pose>0 " + y +
         " 1 0 0 0</pose><link name='post'><inertial><mass>50</mass></inertial></link>"
         "<link name='leaf'><pose>0.6 0 0 0 0 0</pose><inertial><mass>5</mass></inertial></link>"
         "<joint name='ground' type='fixed'><parent>world</parent><child>post</child></joint>"
         "<joint name='hinge' type='revolute'><parent>post</parent><child>leaf</child>"
         "<pose>-0.55 0 0 0 0 0</pose><axis><xyz>0 0 1</xyz><limit>" +
         limits + "</limit><dynamics><damping>1</damping></dynamics></axis></joint></model>";
}

/// Returns the gate's links as saved at an angle of its leaf.
std::string open_gate(const std::string& name, double y, double angle) {
  const auto pose = [](double x, double py, double yaw) {
    return "<pose>" + std::to_string(x) + " " + std::to_string(py) + " 1 0 0 " +
           std::to_string(yaw) + "</pose>";
  };
  return "<model name='" + name + "'>" + pose(0, y, 0) + "<link name='post'>" + pose(0, y, 0) +
         "</link><link name='leaf'>" +
         pose(0.05 + 0.55 * std::cos(angle), y + 0.55 * std::sin(angle), angle) + "</link></model>";
}

std::string state(const std::string& body) {
  return "<state world_name='test'>" + body + "</state>";
}

double hinge(TestWorld& world, const std::string& name) {
  const Robot& robot = *world->find(name)->robot;
  return robot.dynamics().joint_position(robot.joint_index("hinge", {}));
}

Vector3d leaf(TestWorld& world, const std::string& name) {
  return world->state(name + "::leaf", "").pose.p;
}

TEST(SavedState, ADoorStandsAsFarOpenAsItWas) {
  TestWorld world(gate("one", "4") + gate("two", "-4") +
                  state(open_gate("one", 4, M_PI / 2) + open_gate("two", -4, -0.5)));
  EXPECT_NEAR(hinge(world, "one"), M_PI / 2, 1e-5);
  EXPECT_NEAR(hinge(world, "two"), -0.5, 1e-5);
  EXPECT_LT((leaf(world, "one") - Vector3d(0.05, 4.55, 1)).norm(), 1e-5);
  world.run(0.2);  // no force pulls it back
  EXPECT_NEAR(hinge(world, "one"), M_PI / 2, 1e-4);
  EXPECT_NEAR(hinge(world, "two"), -0.5, 1e-4);
}

TEST(SavedState, AnAngleOfMoreThanHalfATurnIsTheOneWithinTheLimits) {
  TestWorld world(gate("one", "4", "<lower>0</lower><upper>4</upper>") +
                  state(open_gate("one", 4, 3.5)));
  EXPECT_NEAR(hinge(world, "one"), 3.5, 1e-5);
  world.run(0.2);
  EXPECT_NEAR(hinge(world, "one"), 3.5, 1e-4);
}

TEST(SavedState, ResetsGoBackToIt) {
  TestWorld world(gate("one", "4") +
                  state("<sim_time>3 250000000</sim_time>" + open_gate("one", 4, M_PI / 2)));
  const auto swing = [&] {
    const Robot& robot = *world->find("one")->robot;
    const std::size_t joint = robot.joint_index("hinge", {});
    for (int i = 0; i < 300; ++i) {
      robot.dynamics().apply_joint_effort(joint, -20.0);
      world->step();
    }
  };
  EXPECT_EQ(world->now_ns(), 3'250'000'000);
  swing();
  EXPECT_EQ(world->now_ns(), 3'550'000'000);
  EXPECT_LT(hinge(world, "one"), 1.4);
  world->reset_world();
  EXPECT_NEAR(hinge(world, "one"), M_PI / 2, 1e-5);
  EXPECT_EQ(world->now_ns(), 3'550'000'000);
  swing();
  world->reset_simulation();
  EXPECT_NEAR(hinge(world, "one"), M_PI / 2, 1e-5);
  EXPECT_EQ(world->now_ns(), 3'250'000'000);
}

TEST(SavedState, AFreeLinkGoesOnAsItMoved) {
  TestWorld world(
      "<gravity>0 0 0</gravity><model name='ball'><link name='l'><inertial><pose>0.2 0 0 0 0 "
      "0</pose>"
      "<mass>1</mass></inertial></link></model>" +
      state("<model name='ball'><pose>9 9 9 0 0 0</pose><link name='l'><pose>1 2 3 0 0 0</pose>"
            "<velocity>1 0 0 0 0 2</velocity></link></model>"));
  const RelativeState first = world->state("ball::l", "");
  EXPECT_LT((first.pose.p - Vector3d(1, 2, 3)).norm(), 1e-12);
  EXPECT_LT((first.twist.linear - Vector3d(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((first.twist.angular - Vector3d(0, 0, 2)).norm(), 1e-12);
  // Its centre of mass, 0.2 m along x, moves at (1, 0.4, 0) m/s; it turns at 2 rad/s.
  world.run(0.5);
  const RelativeState last = world->state("ball::l", "");
  const Vector3d com(1.2 + 0.5, 2 + 0.2, 3);
  EXPECT_LT((last.pose * Vector3d(0.2, 0, 0) - com).norm(), 1e-9);
  EXPECT_NEAR(rpy_from_quaternion(last.pose.q).z(), 1.0, 1e-9);
}

TEST(SavedState, ASensorOfAStaticModelMeasuresFromWhereItsLinkWasMoved) {
  const std::string box = "<geometry><box><size>1 1 1</size></box></geometry>";
  TestWorld world(
      "<model name='wall'><static>true</static><link name='l'><collision name='c'>" + box +
      "</collision></link></model>" +
      state("<model name='wall'><pose>0 0 0 0 0 0</pose><link name='l'><pose>5.5 0 0 0 0 0"
            "</pose></link></model>"));
  world.spawn(lidar_post("libgazebo_ros_laser.so", "ray", 3), "post");
  world.run(0.1);
  EXPECT_NEAR(world.recorder().on<LidarReading>("/scan").at(0).ranges_m.at(1), 5.0, 1e-5);
}

TEST(SavedState, ClockAndRatesStartAtTheSavedTime) {
  TestWorld world(state("<sim_time>1000 10000000</sim_time>"));
  world.spawn(lidar_post("libgazebo_ros_laser.so", "ray", 3), "post");
  world.run(0.1);  // 40 Hz: at 1000.025, .05, .075, .1
  const auto scans = world.recorder().on<LidarReading>("/scan");
  ASSERT_EQ(scans.size(), 4u);
  EXPECT_EQ(scans.at(0).header.stamp_ns, 1000'025'000'000);
}

}  // namespace
}  // namespace ardee
