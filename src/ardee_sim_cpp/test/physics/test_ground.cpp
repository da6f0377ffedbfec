// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "ardee_sim/physics/height_field_contacts.h"
#include "models.h"
#include "rover.h"

namespace ardee::test {
using namespace physics;
namespace {

class Ground : public testing::TestWithParam<double> {
 protected:
  double h() const { return GetParam(); }
};

INSTANTIATE_TEST_SUITE_P(Steps, Ground, testing::Values(0.001, 0.005));

/// Returns a wheel alone, in the x-z plane, free to roll along x.
std::shared_ptr<Model> wheel_model() {
  auto result = model(rover_wheel("wheel", {}));
  return result;
}

void add_flat(PhysicsWorld& world, bool as_heightmap) {
  if (!as_heightmap) return add_ground(world);
  const auto flat = height_grid(65, 20.0, [](double, double) { return 0.0; });
  world.add_scenery({placement(static_model(heightmap(flat)))});
}

TEST_P(Ground, WheelRollsItsCircumferenceWithoutSlip) {
  for (const bool as_heightmap : {false, true}) {
    PhysicsWorld world(params(h()), silent());
    add_flat(world, as_heightmap);
    PhysicsModel& wheel = world.add_model(wheel_model(), at(-4.03, 0.07, 0.097));
    const double omega = 6.0;
    wheel.set_twist({{omega * 0.097, 0, 0}, {0, omega, 0}});
    run(world, 2.0);  // the soft tyre sinks into the contact layer first
    const double x0 = wheel.pose().p.x(), y0 = wheel.pose().p.y(), z0 = wheel.pose().p.z();
    double turned = 0.0, lowest = z0, highest = z0;
    for (int i = 0; i < steps(world, 5.0); ++i) {
      world.step();
      turned += wheel.link_twist(0).angular.y() * h();
      lowest = std::min(lowest, wheel.pose().p.z());
      highest = std::max(highest, wheel.pose().p.z());
    }
    EXPECT_NEAR(wheel.pose().p.x() - x0, 0.097 * turned, 0.002 * 0.097 * turned);
    EXPECT_GT(turned, 0.99 * omega * 5.0) << "nothing slows it";
    EXPECT_NEAR(wheel.pose().p.y(), y0, 1e-3);
    EXPECT_LT(highest - lowest, 1e-4) << "it rolls without jolts";
  }
}

TEST_P(Ground, SphereRestsOnABumpAtItsHeight) {
  const auto bump = height_grid(41, 4.0, [](double x, double y) {
    return std::abs(x - 1.0) < 0.55 && std::abs(y + 0.5) < 0.25 ? 0.37 : 0.0;
  });
  PhysicsWorld world(params(h()), silent());
  world.add_scenery({placement(static_model(heightmap(bump)), at(10, 20, 1))});
  PhysicsModel& on = world.add_model(sphere_model(1, 0.1), at(11, 19.5, 1.6));
  PhysicsModel& beside = world.add_model(sphere_model(1, 0.1), at(9, 20.5, 1.3));
  run(world, 2.0);
  EXPECT_NEAR(on.pose().p.z(), 1.0 + 0.37 + 0.1, 2e-3);
  EXPECT_NEAR(beside.pose().p.z(), 1.0 + 0.1, 2e-3);
}

TEST_P(Ground, ScaleAndRotationOfAHeightmapAreThoseOfItsPlacement) {
  // The ground is higher towards +x in its own frame; turned by 90 degrees this is +y.
  const auto ramp = height_grid(21, 2.0, [](double x, double) { return x > 0.35 ? 0.2 : 0.0; });
  PhysicsWorld world(params(h()), silent());
  const Pose turned = Pose::from_xyz_rpy({0, 0, 0.5}, {0, 0, M_PI / 2});
  world.add_scenery({placement(static_model(heightmap(ramp)), turned, 2.0)});
  PhysicsModel& up = world.add_model(sphere_model(1, 0.1), at(0.3, 1.4, 1.2));
  PhysicsModel& down = world.add_model(sphere_model(1, 0.1), at(1.4, 0.1, 1.2));
  run(world, 2.0);
  EXPECT_NEAR(up.pose().p.z(), 0.5 + 0.4 + 0.1, 2e-3);
  EXPECT_NEAR(down.pose().p.z(), 0.5 + 0.1, 2e-3);
}

TEST_P(Ground, SphereRollsDownATiltedHeightmapAsPredicted) {
  const double slope = 0.1;
  const auto plane = height_grid(101, 40.0, [&](double x, double) { return slope * x; });
  PhysicsWorld world(params(h()), silent());
  world.add_scenery({placement(static_model(heightmap(plane)))});
  const double angle = std::atan(slope), r = 0.1;
  PhysicsModel& ball = world.add_model(
      sphere_model(1, r), at(-r * std::sin(angle), 0.123, r * std::cos(angle) - 0.0005));
  run(world, 2.0);
  // The acceleration of a rolling solid sphere is 5/7 g sin(angle).
  const double way = 0.5 * 5.0 / 7.0 * kGravity * std::sin(angle) * 4.0;
  const Eigen::Vector3d moved = ball.pose().p;
  EXPECT_NEAR(moved.x() + r * std::sin(angle), -way * std::cos(angle),
              0.01 * way + 3.0 * h() * 1.4);
  EXPECT_NEAR(moved.z(), slope * moved.x() + r / std::cos(angle), 2e-3);
  EXPECT_NEAR(moved.y(), 0.123, 1e-3);
}

TEST_P(Ground, WheelOverRidgesNeitherSinksNorJolts) {
  const auto ridges = [](double x, double) { return 0.03 * std::sin(2.0 * M_PI * x / 1.6); };
  const auto grid = height_grid(201, 20.0, ridges);
  const physics::HeightField field(grid);
  PhysicsWorld world(params(h()), silent());
  world.add_scenery({placement(static_model(heightmap(grid)))});
  PhysicsModel& wheel = world.add_model(wheel_model(), at(-5, 0.03, 0.13));
  wheel.set_twist({{0.8, 0, 0}, {0, 0.8 / 0.097, 0}});
  run(world, 0.5);
  double deepest = 0.0, jolt = 0.0, previous = wheel.link_twist(0).linear.z();
  for (int i = 0; i < steps(world, 5.0); ++i) {
    world.step();
    physics::ContactPoints contacts;
    const Pose X_FC = wheel.pose() * Pose::from_xyz_rpy({0, 0, 0}, {M_PI / 2, 0, 0});
    physics::collide_cylinder(field, X_FC, {0.097, 0.038}, contacts);
    for (const auto& contact : contacts) deepest = std::max(deepest, contact.depth_m);
    jolt = std::max(jolt, std::abs(wheel.link_twist(0).linear.z() - previous));
    previous = wheel.link_twist(0).linear.z();
  }
  EXPECT_LT(deepest, 0.0015);
  // Between two facets the slope changes by 0.03 (2 pi / 1.6)^2 0.1 = 0.046: at 0.9 m/s this is a
  // change of at most 0.04 m/s.
  EXPECT_LT(jolt, 0.06 + kGravity * h());
  EXPECT_NEAR(wheel.pose().p.y(), 0.03, 0.05);
}

TEST_P(Ground, BoxRestsStillOnAHeightmap) {
  const auto waves = height_grid(81, 8.0, [](double x, double y) {
    return 0.05 * std::sin(2.0 * x) + 0.04 * std::cos(3.0 * y);
  });
  PhysicsWorld world(params(h()), silent());
  world.add_scenery({placement(static_model(heightmap(waves)))});
  PhysicsModel& body = world.add_model(box_model(5, {0.5, 0.4, 0.2}), at(0.4, 0.3, 0.4));
  run(world, 4.0);
  const Pose before = body.pose();
  run(world, 3.0);
  EXPECT_LT((body.pose().p - before.p).norm(), 1e-5);
  EXPECT_LT(body.pose().q.angularDistance(before.q), 1e-5);
  EXPECT_GT(before.p.z(), 0.1);
}

TEST_P(Ground, BoxStandsOnAPeakBelowItsFace) {
  // One vertex rises above the plain, under the middle of the box.
  const auto peak =
      height_grid(41, 4.0, [](double x, double y) { return std::hypot(x, y) < 0.05 ? 0.1 : 0.0; });
  PhysicsWorld world(params(h()), silent());
  world.add_scenery({placement(static_model(heightmap(peak)))});
  PhysicsModel& body = world.add_model(box_model(5, {0.6, 0.6, 0.2}), at(0, 0, 0.35));
  run(world, 0.5);
  EXPECT_GT(body.pose().p.z(), 0.1 + 0.1 * std::cos(0.35) - 0.01);
}

TEST(GroundContacts, CylinderFacesAndRidgesInClosedForm) {
  // A roof: two planes of slope 1 that meet along y at x = 0.
  const auto grid = height_grid(21, 2.0, [](double x, double) { return -std::abs(x); });
  const physics::HeightField field(grid);
  const Pose level = Pose::from_xyz_rpy({0, 0.02, 0.098}, {M_PI / 2, 0, 0});
  physics::ContactPoints contacts;
  physics::collide_cylinder(field, level, {0.1, 0.04}, contacts);
  ASSERT_EQ(contacts.size(), 3u) << "both ends and the middle";
  for (const auto& contact : contacts) {
    EXPECT_NEAR(contact.depth_m, 0.002, 1e-9);
    EXPECT_NEAR(contact.position.x(), 0.0, 1e-9);
    EXPECT_LT((contact.normal - Eigen::Vector3d::UnitZ()).norm(), 1e-9);
  }
  // On one flank the nearest point lies along the plane's normal.
  const double side = 0.099 * std::sqrt(0.5);
  contacts.clear();
  physics::collide_cylinder(field,
                            Pose::from_xyz_rpy({0.43 + side, 0.02, -0.43 + side}, {M_PI / 2, 0, 0}),
                            {0.1, 0.04}, contacts);
  ASSERT_EQ(contacts.size(), 3u);
  for (const auto& contact : contacts) {
    EXPECT_NEAR(contact.depth_m, 0.001, 1e-7);
    EXPECT_LT((contact.normal - Eigen::Vector3d(1, 0, 1).normalized()).norm(), 1e-6);
  }
}

TEST(GroundContacts, DepthChangesSmoothlyWhileAWheelRollsOn) {
  const auto grid = height_grid(101, 10.0, [](double x, double y) {
    return 0.05 * std::sin(3.1 * x + 0.3) * std::cos(2.3 * y + 0.7);
  });
  const physics::HeightField field(grid);
  double previous = -1.0, worst = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double x = -4.0 + 4e-4 * i, y = 0.3 * x;
    physics::ContactPoints contacts;
    const double ground = 0.05 * std::sin(3.1 * x + 0.3) * std::cos(2.3 * y + 0.7);
    const Pose pose = Pose::from_xyz_rpy({x, y, ground + 0.085}, {M_PI / 2, 0, 0.29});
    physics::collide_cylinder(field, pose, {0.097, 0.038}, contacts);
    ASSERT_FALSE(contacts.empty()) << "at x = " << x;
    double deepest = 0.0;
    for (const auto& contact : contacts) deepest = std::max(deepest, contact.depth_m);
    if (previous >= 0.0) worst = std::max(worst, std::abs(deepest - previous));
    previous = deepest;
  }
  // In 0.4 mm the ground rises by at most 0.4 mm times the slope of 0.19; the shape adds at most
  // another such slope.
  EXPECT_LT(worst, 2.0 * 4e-4 * 0.25);
}

}  // namespace
}  // namespace ardee::test
