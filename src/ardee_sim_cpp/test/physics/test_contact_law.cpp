// SPDX-License-Identifier: MIT
// Tests of the contact that two surfaces give.
#include <gtest/gtest.h>

#include "joints.h"

namespace ardee::test {
using namespace physics;
namespace {

PhysicsParams layered(double layer_m) {
  PhysicsParams made = params(0.001);
  made.contact_surface_layer_m = layer_m;
  return made;
}

/// Returns how deep a box of 2 kg rests in the ground [m].
double rest_depth(double layer_m, const Surface& surface, const Surface& ground) {
  PhysicsWorld world(layered(layer_m), silent());
  add_ground(world, ground);
  PhysicsModel& box = world.add_model(box_model(2, {0.4, 0.3, 0.2}, surface), at(0, 0, 0.0995));
  run(world, 4.0);
  return 0.1 - box.pose().p.z();
}

Surface stiff(double min_depth_m) {
  Surface surface;
  surface.kp_n_per_m = 1e6;
  surface.min_depth_m = min_depth_m;
  surface.max_correcting_velocity_m_per_s = 0.1;
  return surface;
}

TEST(ContactParameters, ADepthOfItsOwnTakesThePlaceOfTheWorldsLayer) {
  const double sinks_m = 2 * kGravity / 4 / 1e6;  // four corners on springs
  EXPECT_NEAR(rest_depth(0.01, stiff(0.002), Surface{}), 0.002 + sinks_m, 1e-5);
  EXPECT_NEAR(rest_depth(0.0, stiff(0.002), Surface{}), 0.002 + sinks_m, 1e-5);
  EXPECT_NEAR(rest_depth(0.01, stiff(0.002), stiff(0.02)), 0.002 + 2 * sinks_m, 2e-5)
      << "scenery is no body and has no depth";
}

TEST(ContactParameters, ABodyWithoutADepthKeepsAtMostAMillimetreOfTheLayer) {
  const double sinks_m = 2 * kGravity / 4 / 1e6;
  EXPECT_NEAR(rest_depth(0.01, stiff(0.0), Surface{}), 0.001 + sinks_m, 1e-5);
  EXPECT_NEAR(rest_depth(0.01, stiff(-0.5), Surface{}), 0.001 + sinks_m, 1e-5);
  EXPECT_NEAR(rest_depth(0.0002, stiff(0.0), Surface{}), 0.0002 + sinks_m, 1e-4);
}

TEST(ContactParameters, OfTwoBodiesTheSmallerDepthCounts) {
  PhysicsWorld world(layered(0.01), silent());
  auto table = box_model(100, {1, 1, 0.2}, stiff(0.003));
  table->links[0].kinematic = true;
  world.add_model(table, at(0, 0, 0));
  PhysicsModel& box = world.add_model(box_model(2, {0.2, 0.2, 0.2}, stiff(0.008)), at(0, 0, 0.197));
  run(world, 2.0);
  EXPECT_NEAR(0.2 - box.pose().p.z(), 0.003 + 2 * 2 * kGravity / 4 / 1e6, 2e-5);
}

TEST(ContactParameters, ABodyIsPushedOutAsFastAsItMayBe) {
  for (const double own : {0.05, 0.3, -1.0}) {
    Surface surface;
    surface.max_correcting_velocity_m_per_s = own;
    PhysicsParams slow = weightless(0.001);
    slow.max_correcting_velocity_m_per_s = 0.6;
    PhysicsWorld world(slow, silent());
    add_ground(world);  // its own 0.01 m/s belong to no body
    PhysicsModel& box = world.add_model(box_model(2, {0.2, 0.2, 0.2}, surface), at(0, 0, 0.05));
    run(world, 0.05);
    EXPECT_NEAR(box.link_twist(0).linear.z(), own < 0 ? 0.6 : own, 1e-4);
  }
}

TEST(ContactParameters, BodiesMeetWhereMasksDo) {
  struct Case {
    std::uint32_t category_a, mask_a, category_b, mask_b;
    bool meet;
  };
  for (const Case& c :
       {Case{0xFFFF, 0xFFFF, 0xFFFF, 0xFFFF, true}, Case{1, 1, 2, 2, false}, Case{1, 1, 3, 3, true},
        Case{0, 0, 0xFFFF, 0xFFFF, false}, Case{1, 0, 2, 1, true}, Case{1, 2, 2, 0, true},
        Case{1, 0, 2, 0, false}, Case{0x10000, 0x10000, 0x10000, 0x10000, true}}) {
    Surface ground, ball;
    ground.category_bitmask = c.category_a;
    ground.collide_bitmask = c.mask_a;
    ball.category_bitmask = c.category_b;
    ball.collide_bitmask = c.mask_b;
    const auto flat = height_grid(41, 8.0, [](double, double) { return 0.0; });
    for (const Geometry& shape : {Geometry(Plane{}), heightmap(flat)}) {
      PhysicsWorld world(params(0.001), silent());
      world.add_scenery({placement(static_model(shape, ground))});
      PhysicsModel& body = world.add_model(sphere_model(1, 0.1, ball), at(0.1, 0.2, 0.1));
      run(world, 0.5);
      EXPECT_EQ(body.pose().p.z() > 0.05, c.meet) << c.mask_a << " and " << c.mask_b;
    }
  }
}

TEST(ContactParameters, WhatCollidesWithoutContactFallsThrough) {
  for (const bool of_ground : {false, true}) {
    Surface ghost;
    ghost.collide_without_contact = true;
    PhysicsWorld world(params(0.001), silent());
    add_ground(world, of_ground ? ghost : Surface{});
    PhysicsModel& body =
        world.add_model(sphere_model(1, 0.1, of_ground ? Surface{} : ghost), at(0, 0, 0.1));
    run(world, 0.5);
    EXPECT_NEAR(body.link_twist(0).linear.z(), -kGravity * 0.5, 1e-9);
  }
}

TEST(ContactParameters, UnlimitedFrictionNeverSlides) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double other : {infinity, 1e30}) {
    Surface grip;
    grip.mu = grip.mu2 = infinity;
    grip.kp_n_per_m = 1e30;
    grip.kd_n_s_per_m = 1e30;
    Surface ground;
    ground.mu = ground.mu2 = other;
    PhysicsWorld world(params(0.001), silent());
    add_ground(world, ground);
    PhysicsModel& crate = world.add_model(box_model(5, {0.5, 0.5, 0.5}, grip), at(0, 0, 0.25));
    run(world, 0.5);
    const double before = crate.pose().p.x();
    for (int i = 0; i < steps(world, 2.0); ++i) {
      crate.apply_wrench(0, {45, 0, 0}, crate.pose().p, {0, 0, 0});  // tips from 49 N on
      world.step();
    }
    EXPECT_NEAR(crate.pose().p.x(), before, 1e-4);
    EXPECT_NEAR(rpy_from_quaternion(crate.pose().q).y(), 0.0, 1e-3);
  }
}

TEST(ContactParameters, APatchResistsTurningOnTheSpot) {
  // Hertz's pressure on a patch of radius a: a moment of 3 pi / 16 a mu N.
  Surface rubber;
  rubber.torsional_mu = 0.8;
  rubber.patch_radius_m = 0.02;
  PhysicsWorld world(params(0.001), silent());
  Surface ground;
  add_ground(world, ground);
  PhysicsModel& ball = world.add_model(sphere_model(1, 0.1, rubber), at(0, 0, 0.099));
  run(world, 0.5);
  ball.set_twist({{0, 0, 0}, {0, 0, 20}});
  run(world, 0.5);
  const double moment = 3 * M_PI / 16 * 0.02 * 0.8 * kGravity;
  EXPECT_NEAR(ball.link_twist(0).angular.z(), 20 - moment / (0.4 * 0.01) * 0.5, 0.02);
}

}  // namespace
}  // namespace ardee::test
