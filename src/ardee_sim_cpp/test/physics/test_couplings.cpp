// SPDX-License-Identifier: MIT
// Tests of joints that follow others: gears, grippers, rocker differentials.
#include <gtest/gtest.h>

#include "ardee_sim/core/error.h"
#include "joints.h"

namespace ardee::test {
using namespace physics;
namespace {

constexpr double kStep_s = 0.001;

Joint hinge(const std::string& name, const std::string& parent, const std::string& child) {
  Joint joint;
  joint.name = name;
  joint.type = JointType::kContinuous;
  joint.parent = parent;
  joint.child = child;
  return joint;
}

/// Returns two wheels of 0.1 kg m^2 on a frame; the second follows the first.
std::shared_ptr<Model> geared(double multiplier, double offset = 0.0) {
  auto made = model(link("frame", wheel_inertial(10.0, 1.0)));
  made->links.push_back(link("a", wheel_inertial(1.0, 0.1)));
  made->links.push_back(link("b", wheel_inertial(1.0, 0.1)));
  made->links[2].X_ML.p = {1, 0, 0};
  made->joints = {hinge("ground", "world", "frame"), hinge("ja", "frame", "a"),
                  hinge("jb", "frame", "b")};
  made->joints[0].type = JointType::kFixed;
  Coupling coupling;
  coupling.leader = "ja";
  coupling.follower = "jb";
  coupling.multiplier = multiplier;
  coupling.offset = offset;
  made->couplings.push_back(coupling);
  return made;
}

void run(
    PhysicsWorld& world, double duration_s, const std::function<void()>& before = [] {}) {
  for (int i = 0; i < static_cast<int>(std::lround(duration_s / kStep_s)); ++i) {
    before();
    ASSERT_TRUE(world.step().empty());
  }
}

TEST(Couplings, AGearFeelsTheOtherWheelsInertia) {
  // The moment is 0.1 + 2^2 * 0.1 = 0.5 kg m^2: 1 N m for 0.5 s gives 1 rad/s, and 2 rad/s beyond
  // the gear.
  PhysicsWorld world(weightless(kStep_s), silent());
  PhysicsModel& made = world.add_model(geared(2.0), Pose{});
  run(world, 0.5, [&] { made.apply_joint_effort(1, 1.0); });
  EXPECT_NEAR(made.joint_velocity(1), 1.0, 1e-3);
  EXPECT_NEAR(made.joint_velocity(2), 2.0, 2e-3);
  EXPECT_NEAR(made.joint_position(2), 2.0 * made.joint_position(1), 1e-6);
}

TEST(Couplings, AnEffortOnTheFollowerDrivesTheLeader) {
  // 1 N m behind a gear of -2 is -2 N m before it.
  PhysicsWorld world(weightless(kStep_s), silent());
  PhysicsModel& made = world.add_model(geared(-2.0), Pose{});
  run(world, 0.5, [&] { made.apply_joint_effort(2, 1.0); });
  EXPECT_NEAR(made.joint_velocity(1), -2.0, 2e-3);
  EXPECT_NEAR(made.joint_velocity(2), 4.0, 4e-3);
}

TEST(Couplings, AGearHoldsOnARobotThatTurns) {
  // The frame is free: the turn relative to it counts. No outer torque acts, so the angular
  // momentum about z remains that of the throw.
  auto model = geared(2.0);
  model->joints.erase(model->joints.begin());
  PhysicsWorld world(weightless(kStep_s), silent());
  PhysicsModel& made = world.add_model(model, Pose{});
  made.set_twist({{0, 0, 0}, {0, 0, 1.0}});
  run(world, 0.5, [&] { made.apply_joint_effort(0, 1.0); });
  EXPECT_NEAR(made.joint_velocity(1), 2.0 * made.joint_velocity(0), 1e-6);
  EXPECT_NEAR(made.joint_position(1), 2.0 * made.joint_position(0), 1e-6);
  EXPECT_GT(made.joint_velocity(0), 0.5);
}

TEST(Couplings, TheOffsetIsReachedAndHeldUnderALoadWhileDriven) {
  PhysicsWorld world(weightless(kStep_s), silent());
  PhysicsModel& made = world.add_model(geared(-0.5, 0.3), Pose{});
  run(world, 0.6);  // at 1 rad/s
  EXPECT_NEAR(made.joint_position(2), -0.5 * made.joint_position(1) + 0.3, 1e-6);
  made.set_joint_motor(1, 3.0, 1000.0);
  run(world, 0.1, [&] { made.apply_joint_effort(2, 5.0); });
  double worst = 0.0;
  run(world, 1.0, [&] {
    made.apply_joint_effort(2, 5.0);
    const double wanted = -0.5 * made.joint_position(1) + 0.3;
    worst = std::max(worst, std::abs(made.joint_position(2) - wanted));
  });
  EXPECT_NEAR(made.joint_velocity(1), 3.0, 1e-3);
  EXPECT_NEAR(made.joint_velocity(2), -1.5, 1e-3);
  EXPECT_LT(worst, 1e-6);
}

TEST(Couplings, AFollowerOfLittleStrengthGivesWay) {
  // The follower's wheel turns with at most 0.2 N m: 2 rad/s^2.
  auto model = geared(1.0);
  model->couplings[0].max_effort = 0.2;
  PhysicsWorld world(weightless(kStep_s), silent());
  PhysicsModel& made = world.add_model(model, Pose{});
  made.set_joint_motor(1, 10.0, 1000.0);
  run(world, 0.5);
  EXPECT_NEAR(made.joint_velocity(1), 10.0, 1e-6);
  EXPECT_NEAR(made.joint_velocity(2), 1.0, 1e-3);
}

TEST(Couplings, FingersCloseOnABoxAndHoldIt) {
  // Two fingers slide; the second follows the first. 20 N at the first are 10 N at each, and
  // friction, 2 * 10 N, holds a box of 0.5 kg (4.9 N) between them.
  auto hand = model(link("palm", wheel_inertial(5.0, 0.1)));
  for (const char* name : {"left", "right"}) {
    Link finger = link(name, wheel_inertial(0.2, 1e-3));
    finger.X_ML.p = {name[0] == 'l' ? -0.1 : 0.1, 0, 0};
    finger.collisions.push_back(collision(Box{{0.02, 0.05, 0.04}}));
    hand->links.push_back(finger);
    Joint slide = hinge(std::string(name) + "_slide", "palm", name);
    slide.type = JointType::kPrismatic;
    slide.axis.axis = {1, 0, 0};
    slide.axis.damping = 50.0;
    hand->joints.push_back(slide);
  }
  hand->joints.push_back(hinge("hold", "world", "palm"));
  hand->joints.back().type = JointType::kFixed;
  Coupling coupling;
  coupling.leader = "left_slide";
  coupling.follower = "right_slide";
  coupling.multiplier = -1.0;
  hand->couplings.push_back(coupling);
  PhysicsWorld world(params(kStep_s), silent());
  PhysicsModel& gripper = world.add_model(hand, at(0, 0, 1));
  PhysicsModel& box = world.add_model(box_model(0.5, {0.1, 0.05, 0.05}), at(0.01, 0, 1), "box");
  const auto table =
      world.add_scenery({placement(static_model(Box{{1, 1, 0.1}}), at(0, 0, 0.925))});
  run(world, 0.5, [&] { gripper.apply_joint_effort(0, 20.0); });
  world.remove_scenery(table);
  run(world, 0.5, [&] { gripper.apply_joint_effort(0, 20.0); });
  EXPECT_NEAR(box.pose().p.z(), 1.0, 2e-3);
  EXPECT_NEAR(box.pose().p.x(), 0.0, 2e-3);
  EXPECT_NEAR(gripper.joint_position(1), -gripper.joint_position(0), 1e-3);
}

TEST(Couplings, WhatCannotBeCoupledIsRefused) {
  PhysicsWorld world(params(kStep_s), silent());
  for (const char* name : {"ground", "nowhere", "jb"}) {
    auto model = geared(1.0);
    model->couplings[0].leader = name;
    EXPECT_THROW(world.add_model(model, Pose{}), Error) << name;
  }
  auto model = geared(std::nan(""));
  EXPECT_THROW(world.add_model(model, Pose{}), Error);
}

}  // namespace
}  // namespace ardee::test
