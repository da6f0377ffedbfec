// SPDX-License-Identifier: MIT
// Tests that steps leave out models at rest, and include them again once anything can move them.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "models.h"

namespace ardee::test {
using namespace physics;
namespace {

constexpr double kStep_s = 0.001;
constexpr double kSize_m = 0.2;

class Rest : public ::testing::Test {
 protected:
  Rest() : world_(params(kStep_s), silent()) { add_ground(world_); }

  PhysicsModel& add_box(double x, double z, const std::string& name) {
    return world_.add_model(box_model(1.0, {kSize_m, kSize_m, kSize_m}), at(x, 0, z), name);
  }
  void run(double duration_s) {
    const int steps = static_cast<int>(std::lround(duration_s / kStep_s));
    for (int i = 0; i < steps; ++i) ASSERT_TRUE(world_.step().empty());
  }

  PhysicsWorld world_;
};

TEST_F(Rest, AFallenBoxSleepsAndCostsNothing) {
  PhysicsModel& box = add_box(0, 0.3, "box");
  run(0.3);  // it falls 0.2 m in 0.2 s
  EXPECT_EQ(box.rest(), 0u);
  EXPECT_EQ(world_.stats().models, 1u);
  EXPECT_EQ(world_.stats().contacts, 4u);
  run(1.0);
  EXPECT_NE(box.rest(), 0u);
  EXPECT_EQ(world_.stats().models, 0u);
  EXPECT_EQ(world_.stats().contacts, 0u);
  EXPECT_EQ(world_.stats().scenery_tested, 0u);
  EXPECT_NEAR(box.pose().p.z(), 0.1, 1.1e-3);
  EXPECT_EQ(box.link_twist(0).linear, Eigen::Vector3d(0, 0, 0));
}

TEST_F(Rest, ManySleepersAreNotCompared) {
  for (int i = 0; i < 100; ++i) add_box(0.3 * i, 0.1, "box" + std::to_string(i));
  run(1.0);
  EXPECT_EQ(world_.stats().models, 0u);
  PhysicsModel& ball = world_.add_model(sphere_model(1.0, 0.1), at(-5, 0, 0.1), "ball");
  ball.set_twist({{1, 0, 0}, {0, 10, 0}});
  run(1.0);
  EXPECT_EQ(world_.stats().models, 1u);
  EXPECT_EQ(world_.stats().contacts, 1u);
}

TEST(RestInSpace, MomentumIsConservedWhenASleeperIsHit) {
  // The ball flies level at the middle of a box that stands on a slippery pillar.
  PhysicsWorld world(params(kStep_s), silent());
  Surface ice;
  ice.mu = ice.mu2 = 0.0;
  world.add_scenery({placement(static_model(Box{{4, 4, 1}}, ice), at(0, 0, -0.5))});
  PhysicsModel& box = world.add_model(box_model(1.0, {0.2, 0.2, 0.2}, ice), at(0, 0, 0.1), "box");
  for (int i = 0; i < 1000; ++i) world.step();
  ASSERT_NE(box.rest(), 0u);
  PhysicsModel& ball = world.add_model(sphere_model(2.0, 0.1, ice), at(-0.5, 0, 0.1), "ball");
  ball.set_twist({{1.5, 0, 0}, {0, 0, 0}});
  for (int i = 0; i < 400; ++i) world.step();
  EXPECT_EQ(box.rest(), 0u);
  const double momentum = 1.0 * box.link_twist(0).linear.x() + 2.0 * ball.link_twist(0).linear.x();
  EXPECT_NEAR(momentum, 3.0, 1e-3);
  EXPECT_NEAR(box.link_twist(0).linear.x(), 1.0, 0.05);  // without a bounce both move on together
}

TEST_F(Rest, ASleeperFallsWhenItsSupportIsRemoved) {
  PhysicsModel& low = add_box(0, 0.1, "low");
  PhysicsModel& high = add_box(0, 0.3, "high");
  run(1.5);
  ASSERT_NE(high.rest(), 0u);
  world_.remove_model(low);
  EXPECT_EQ(high.rest(), 0u);
  run(0.1);
  EXPECT_NEAR(high.link_twist(0).linear.z(), -kGravity * 0.1, 0.01);
  run(1.5);
  EXPECT_NEAR(high.pose().p.z(), 0.1, 1.1e-3);
  EXPECT_NE(high.rest(), 0u);
}

TEST_F(Rest, ASleeperFallsWhenItsSceneryIsRemoved) {
  const auto shelf = world_.add_scenery({placement(static_model(Box{{1, 1, 1}}), at(5, 0, 0.5))});
  PhysicsModel& on_shelf = add_box(5, 1.1, "on_shelf");
  PhysicsModel& elsewhere = add_box(0, 0.1, "elsewhere");
  run(1.0);
  const std::uint64_t rest = elsewhere.rest();
  ASSERT_NE(rest, 0u);
  world_.remove_scenery(shelf);
  EXPECT_EQ(on_shelf.rest(), 0u);
  EXPECT_EQ(elsewhere.rest(), rest);
  run(0.1);
  EXPECT_NEAR(on_shelf.link_twist(0).linear.z(), -kGravity * 0.1, 0.01);
}

TEST_F(Rest, ASleeperFallsWhenItsSupportIsPulledAway) {
  PhysicsModel& low = add_box(0, 0.1, "low");
  PhysicsModel& high = add_box(0, 0.3, "high");
  run(1.5);
  ASSERT_NE(high.rest(), 0u);
  low.set_state(at(3, 0, 0.1), Twist{});
  run(0.1);
  EXPECT_NEAR(high.link_twist(0).linear.z(), -kGravity * 0.1, 0.01);
}

TEST_F(Rest, WhatActsOnASleeperWakesIt) {
  PhysicsModel& box = add_box(0, 0.1, "box");
  const auto wakes = [&](const char* what, const std::function<void()>& act) {
    run(1.0);
    ASSERT_NE(box.rest(), 0u) << what;
    act();
    EXPECT_EQ(box.rest(), 0u) << what;
  };
  const Eigen::Vector3d none(0, 0, 0);
  wakes("twist", [&] { box.set_twist({{0, 0, 0}, {0, 0, 0}}); });
  wakes("state", [&] { box.set_state(at(1, 0, 0.1), Twist{}); });
  wakes("properties", [&] { box.set_link_properties(0, box.link_properties(0)); });
  wakes("wrench", [&] { box.apply_wrench(0, {20, 0, 0}, box.pose().p, none); });
  run(kStep_s);
  EXPECT_NEAR(box.link_twist(0).linear.x(), (20.0 - kGravity) * kStep_s, 1e-4);  // less friction
  wakes("gravity", [&] {
    PhysicsParams moon = params(kStep_s);
    moon.gravity_m_per_s2 = {0, 0, 1.6};
    world_.set_params(moon);
  });
  run(0.5);
  EXPECT_NEAR(box.link_twist(0).linear.z(), 0.8, 0.01);
}

TEST_F(Rest, WhatMayNotSleepStaysAwake) {
  auto restless = box_model(1.0, {kSize_m, kSize_m, kSize_m});
  restless->allow_auto_disable = false;
  auto sensing = box_model(1.0, {kSize_m, kSize_m, kSize_m});
  sensing->links[0].sensors.emplace_back();
  world_.add_model(restless, at(0, 0, 0.1), "restless");
  world_.add_model(sensing, at(2, 0, 0.1), "sensing");
  PhysicsModel& on_top = add_box(0, 0.3, "on_top");  // on one that is awake
  add_box(4, 0.1, "other");
  run(1.5);
  EXPECT_EQ(world_.stats().models, 3u);
  EXPECT_EQ(on_top.rest(), 0u);
}

TEST(RestInSpace, WhatMovesSlowlyInFreeFlightGoesOn) {
  PhysicsParams no_gravity = params(kStep_s);
  no_gravity.gravity_m_per_s2.setZero();
  PhysicsWorld world(no_gravity, silent());
  PhysicsModel& box = world.add_model(box_model(1.0, {0.2, 0.2, 0.2}), Pose{}, "box");
  box.set_twist({{1e-4, 0, 0}, {0, 0, 0}});
  for (int i = 0; i < 5000; ++i) world.step();
  EXPECT_NEAR(box.pose().p.x(), 5e-4, 1e-9);
}

TEST(RestInSpace, AResultDoesNotDependOnTheOrderOfAddition) {
  const auto run = [](bool turned) {
    PhysicsWorld world(params(kStep_s), silent());
    add_ground(world);
    std::vector<int> order{0, 1, 2, 3, 4};
    if (turned) std::reverse(order.begin(), order.end());
    std::map<int, PhysicsModel*> boxes;
    for (const int i : order) {
      boxes[i] = &world.add_model(box_model(1.0, {0.2, 0.2, 0.2}), at(0.21 * i, 0, 0.1),
                                  std::to_string(i));
    }
    for (int i = 0; i < 1000; ++i) world.step();
    boxes[0]->set_twist({{2, 0, 0}, {0, 0, 1}});
    for (int i = 0; i < 1000; ++i) world.step();
    std::vector<double> found;
    for (const auto& [number, box] : boxes) {
      const Pose pose = box->pose();
      found.insert(found.end(), {pose.p.x(), pose.p.y(), pose.p.z(), pose.q.w(), pose.q.z()});
    }
    return found;
  };
  EXPECT_EQ(run(false), run(true));
}

}  // namespace
}  // namespace ardee::test
