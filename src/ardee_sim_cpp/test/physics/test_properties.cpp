// SPDX-License-Identifier: MIT
// Tests of changes that services make to links and joints while they move.
#include <gtest/gtest.h>

#include "joints.h"

namespace ardee::test {
using namespace physics;
namespace {

using Eigen::Vector3d;

std::string error_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Properties, MassAndGravityOfALinkActFromTheNextStep) {
  PhysicsWorld world(params(0.001), silent());
  PhysicsModel& body = world.add_model(box_model(2.0, {0.2, 0.2, 0.2}), at(0, 0, 5));
  LinkProperties properties = body.link_properties(0);
  properties.inertial->mass_kg = 8.0;
  properties.gravity = false;
  body.set_link_properties(0, properties);
  for (int i = 0; i < 1000; ++i) {
    body.apply_wrench(0, {8, 0, 0}, body.pose().p, {0, 0, 0});
    world.step();
  }
  EXPECT_NEAR(body.link_twist(0).linear.x(), 1.0, 1e-9);
  EXPECT_NEAR(body.pose().p.z(), 5.0, 1e-12);
}

TEST(Properties, GravityOfOnePartPullsWithItsShare) {
  auto description = box_model(2.0, {0.2, 0.2, 0.2});
  description->links.push_back(link("load", box_inertial(1.0, {0.1, 0.1, 0.1})));
  Joint joint;
  joint.name = "fixed";
  joint.parent = "box";
  joint.child = "load";
  description->joints.push_back(joint);
  PhysicsWorld world(params(0.001), silent());
  PhysicsModel& body = world.add_model(description, at(0, 0, 5));
  LinkProperties properties = body.link_properties(1);
  properties.gravity = false;
  body.set_link_properties(1, properties);
  run(world, 0.5);
  EXPECT_NEAR(body.link_twist(0).linear.z(), -kGravity * 0.5 * 2.0 / 3.0, 1e-9);
}

TEST(Properties, AnotherCentreOfMassLeavesPosesAndVelocitiesOfTheLinks) {
  PhysicsWorld world(weightless(0.001), silent());
  const Pose X_WM = Pose::from_xyz_rpy({1, 2, 3}, {0.3, 0.2, 0.1});
  PhysicsModel& body = world.add_model(box_model(2.0, {0.2, 0.4, 0.6}), X_WM);
  body.set_twist({{0.1, 0.2, 0.3}, {0.5, -0.4, 2.0}});
  LinkProperties properties = body.link_properties(0);
  properties.inertial->X_LI.p = {0.1, -0.2, 0.3};
  body.set_link_properties(0, properties);
  EXPECT_LT((body.pose().p - X_WM.p).norm(), 1e-15);
  EXPECT_LT((body.link_twist(0).linear - Vector3d(0.1, 0.2, 0.3)).norm(), 1e-15);
  // A free body turns about its new centre of mass, which goes straight on.
  const Vector3d center = X_WM * properties.inertial->X_LI.p;
  const Vector3d velocity =
      Vector3d(0.1, 0.2, 0.3) + Vector3d(0.5, -0.4, 2.0).cross(center - X_WM.p);
  run(world, 1.0);
  EXPECT_LT((body.pose() * properties.inertial->X_LI.p - (center + velocity)).norm(), 1e-9);
}

TEST(Properties, AHingeHangsWhereItsNewMassPullsIt) {
  for (const JointType type : {JointType::kRevolute, JointType::kUniversal}) {
    PhysicsWorld world(params(0.001), silent());
    auto description = jointed_model(type, wheel_inertial(1.0, 0.01), axis_along({0, 1, 0}));
    description->joints[0].axis2.axis = {0, 0, 1};
    PhysicsModel& arm = world.add_model(description, Pose{});
    JointProperties held = arm.joint_properties(0, 0);
    held.spring = {100.0, 5.0, 0.0};
    arm.set_joint_properties(0, 0, held);
    LinkProperties properties = arm.link_properties(0);
    properties.inertial->mass_kg = 3.0;
    properties.inertial->X_LI.p = {0.5, 0, 0};
    arm.set_link_properties(0, properties);
    run(world, 3.0);
    // The spring's torque balances the weight's: k a = m g L cos(a).
    double angle = 0.0;
    for (int i = 0; i < 50; ++i) angle = 3.0 * kGravity * 0.5 * std::cos(angle) / 100.0;
    EXPECT_NEAR(arm.joint_position(0), angle, 1e-4);
    EXPECT_LT(arm.link_pose(0).p.norm(), 1e-6) << "the hinge stays where it was";
  }
}

TEST(Properties, ASliderKeepsItsZero) {
  PhysicsWorld world(weightless(0.001), silent());
  PhysicsModel& sled = world.add_model(
      jointed_model(JointType::kPrismatic, wheel_inertial(1.0, 0.01), axis_along({1, 0, 0})),
      Pose{});
  sled.set_joint_position(0, 0.3);
  LinkProperties properties = sled.link_properties(0);
  properties.inertial->X_LI.p = {0.2, 0.1, 0};
  sled.set_link_properties(0, properties);
  sled.set_joint_limits(0, -1.0, 0.5);
  sled.set_joint_motor(0, 1.0, 100.0);
  run(world, 1.0);
  EXPECT_NEAR(sled.joint_position(0), 0.5, 1e-6);
  EXPECT_LT((sled.link_pose(0).p - Vector3d(0.5, 0, 0)).norm(), 1e-5);
}

TEST(Properties, DampingStopsAndLimitsOfAnAxisHold) {
  PhysicsWorld world(weightless(0.001), silent());
  PhysicsModel& head = world.add_model(
      jointed_model(JointType::kRevolute, wheel_inertial(1.0, 0.5), axis_along({0, 0, 1})), Pose{});
  const auto push = [&](double effort, double duration_s) {
    for (int i = 0; i < steps(world, duration_s); ++i) {
      head.apply_joint_effort(0, effort);
      world.step();
    }
  };
  JointProperties properties = head.joint_properties(0, 0);
  properties.spring.damping = 2.0;
  head.set_joint_properties(0, 0, properties);
  push(1.0, 3.0);
  EXPECT_NEAR(head.joint_velocity(0), 1.0 / 2.0, 1e-4)
      << "effort / damping, after 12 time constants";
  properties.spring.damping = 0.0;
  properties.max_effort = 0.5;
  properties.max_velocity = 1.2;
  head.set_joint_properties(0, 0, properties);
  push(1.0, 0.5);
  EXPECT_NEAR(head.joint_velocity(0), 0.5 + 0.5 * 0.5 / 0.5, 1e-3) << "no more than 0.5 N m acts";
  push(1.0, 3.0);
  EXPECT_NEAR(head.joint_velocity(0), 1.2, 0.5 / 0.5 * 0.001 + 1e-9);
  push(-1.0, 0.5);
  EXPECT_NEAR(head.joint_velocity(0), 0.7, 2e-3) << "it may always be braked";
  properties.upper = head.joint_position(0) + 0.2;
  head.set_joint_properties(0, 0, properties);
  push(1.0, 3.0);
  EXPECT_NEAR(head.joint_position(0), properties.upper, 1e-4);
}

TEST(Properties, AMotorOfASecondAxisTurnsIt) {
  PhysicsWorld world(weightless(0.001), silent());
  PhysicsModel& wheel = world.add_model(
      jointed_model(JointType::kRevolute2, wheel_inertial(1.0, 0.02), axis_along({0, 0, 1})),
      Pose{});
  ASSERT_EQ(wheel.joint_axes(0), 2u);
  wheel.set_joint_motor(0, 1, {3.0, 10.0});
  EXPECT_EQ(wheel.joint_motor(0, 1).velocity, 3.0);
  run(world, 0.5);
  EXPECT_LT((wheel.link_twist(0).angular - Vector3d(0, 3, 0)).norm(), 1e-6);
  EXPECT_NEAR(wheel.joint_velocity(0), 0.0, 1e-9);
}

TEST(Properties, WhatIsRefusedChangesNothing) {
  const double nan = std::nan("");
  PhysicsWorld world(params(0.001), silent());
  PhysicsModel& body = world.add_model(
      jointed_model(JointType::kRevolute, wheel_inertial(2.0, 0.5), axis_along({0, 0, 1})), Pose{});
  const auto refuses_link = [&](const std::function<void(LinkProperties&)>& change) {
    LinkProperties properties = body.link_properties(0);
    change(properties);
    return error_of([&] { body.set_link_properties(0, properties); });
  };
  EXPECT_NE(refuses_link([](auto& p) { p.inertial->mass_kg = 0.0; }), "");
  EXPECT_NE(refuses_link([&](auto& p) { p.inertial->mass_kg = nan; }), "");
  EXPECT_NE(refuses_link([](auto& p) { p.inertial->inertia_kg_m2(0, 0) = -0.1; }), "");
  EXPECT_NE(refuses_link([&](auto& p) { p.inertial->inertia_kg_m2(0, 1) = nan; }), "");
  EXPECT_NE(refuses_link([&](auto& p) { p.inertial->X_LI.p.x() = nan; }), "");
  EXPECT_NE(refuses_link([](auto& p) { p.inertial.reset(); }), "");
  EXPECT_EQ(body.link_properties(0).inertial->mass_kg, 2.0);
  const auto refuses_joint = [&](const std::function<void(JointProperties&)>& change) {
    JointProperties properties = body.joint_properties(0, 0);
    change(properties);
    return error_of([&] { body.set_joint_properties(0, 0, properties); });
  };
  EXPECT_NE(refuses_joint([](auto& p) { p.spring.damping = -1.0; }), "");
  EXPECT_NE(refuses_joint([&](auto& p) { p.spring.damping = nan; }), "");
  EXPECT_NE(refuses_joint([&](auto& p) { p.lower = nan; }), "");
  EXPECT_NE(refuses_joint([](auto& p) { p.lower = 1.0, p.upper = 0.0; }), "");
  EXPECT_NE(refuses_joint([](auto& p) { p.max_effort = -1.0; }), "");
  EXPECT_NE(refuses_joint([&](auto& p) { p.stop_erp = nan; }), "");
  EXPECT_EQ(body.joint_properties(0, 0).spring.damping, 0.0);
  EXPECT_NE(error_of([&] { body.set_joint_motor(0, 0, {nan, 1.0}); }), "");
  EXPECT_NE(error_of([&] { body.set_joint_motor(0, 0, {1.0, -1.0}); }), "");
  EXPECT_NE(error_of([&] {
              body.set_joint_motor(0, 1, {1.0, 1.0});
            }).find("found axis 1"),
            std::string::npos);
}

}  // namespace
}  // namespace ardee::test
