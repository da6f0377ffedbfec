// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "rover.h"

namespace ardee::test {
namespace {

class Rover : public testing::TestWithParam<double> {
 protected:
  double h() const { return GetParam(); }
};

INSTANTIATE_TEST_SUITE_P(Steps, Rover, testing::Values(0.001, 0.005));

std::shared_ptr<const HeightGrid> field_ground() {
  return height_grid(129, 20.0, [](double x, double y) {
    return 0.02 * std::sin(1.3 * x) * std::cos(1.1 * y) + 0.03 * x;
  });
}

TEST_P(Rover, StandsStillOnItsSprings) {
  for (const bool rough : {false, true}) {
    PhysicsWorld world(params(h()), silent());
    if (rough) {
      world.add_scenery({placement(static_model(heightmap(field_ground())))});
    } else {
      add_ground(world);
    }
    const RoverShape shape;
    PhysicsModel& rover = world.add_model(rover_model(shape), at(0.3, 0.2, 0.18));
    drive(rover, shape, 0.0, 0.0);
    run(world, 3.0);
    const Pose before = rover.pose();
    run(world, 5.0);
    const Pose after = rover.pose();
    EXPECT_LT((after.p - before.p).norm(), 5.0 * 1e-5) << "rough " << rough;
    EXPECT_LT(after.q.angularDistance(before.q), 5.0 * 1e-4);
    EXPECT_LT(rover.link_twist(0).linear.norm(), 1e-4);
    EXPECT_NEAR(before.p.z() - (rough ? 0.03 * before.p.x() : 0.0), 0.08, 0.03);
  }
}

TEST_P(Rover, EachLegCarriesAQuarterOfTheBody) {
  PhysicsWorld world(params(h()), silent());
  add_ground(world);
  PhysicsModel& rover = world.add_model(rover_model(), at(0.3, 0.2, 0.1));
  run(world, 4.0);
  // Wheels roll freely, so that the ground pushes straight up: spring torque = load times the hub's
  // lever about the leg's joint, less the leg's own weight. The lever grows as the leg turns.
  const double load = kGravity * (8.0 + 4 * 0.19) / 4.0;
  double angle = 0.0;
  for (int i = 0; i < 20; ++i) {
    const double lever = 0.13 * std::cos(angle) + 0.09 * std::sin(angle);
    const double own = 0.065 * std::cos(angle) + 0.045 * std::sin(angle);
    angle = (load * lever - 0.19 * kGravity * own) / 100.0;
  }
  for (const std::size_t leg : {0u, 2u, 4u, 6u}) {
    EXPECT_NEAR(std::abs(rover.joint_position(leg)), angle, 0.01 * angle);
  }
}

TEST_P(Rover, DrivesStraightAtTheSpeedOfItsWheels) {
  PhysicsWorld world(params(h()), silent());
  add_ground(world);
  const RoverShape shape;
  PhysicsModel& rover = world.add_model(rover_model(shape), at(0, 0, 0.1));
  run(world, 1.0);
  drive(rover, shape, 5.0, 5.0);
  run(world, 1.0);
  const Pose start = rover.pose();
  double wheel_start = rover.joint_position(wheel_joint(shape, 0));
  run(world, 4.0);
  const double turned = rover.joint_position(wheel_joint(shape, 0)) - wheel_start;
  EXPECT_NEAR(turned, 20.0, 0.02);
  EXPECT_NEAR(rover.pose().p.x() - start.p.x(), 0.097 * turned, 0.005 * 0.097 * turned);
  EXPECT_NEAR(rover.pose().p.y(), start.p.y(), 0.01);
  EXPECT_NEAR(rpy_from_quaternion(rover.pose().q).z(), 0.0, 0.005);
}

TEST_P(Rover, SkidSteersInPlaceWithinTheKinematicBound) {
  for (const bool legs : {false, true}) {
    PhysicsWorld world(params(h()), silent());
    add_ground(world);
    RoverShape shape;
    shape.legs = legs;
    PhysicsModel& rover = world.add_model(rover_model(shape), at(0, 0, 0.1));
    run(world, 1.0);
    drive(rover, shape, -4.0, 4.0);
    run(world, 1.0);
    const Pose start = rover.pose();
    run(world, 2.0);
    const double rate = rover.link_twist(0).angular.z();
    // Wheels at +-omega r over half the track would turn without skidding at omega r / (track / 2);
    // they do skid.
    const double bound = 4.0 * 0.097 / shape.half_track_m;
    EXPECT_LT(rate, bound);
    EXPECT_GT(rate, 0.3 * bound);
    EXPECT_LT((rover.pose().p - start.p).norm(), 0.05);
  }
}

TEST_P(Rover, LegsStayWithinTheirLimitsWhenDropped) {
  PhysicsWorld world(params(h()), silent());
  add_ground(world);
  const RoverShape shape;
  PhysicsModel& rover = world.add_model(rover_model(shape), at(0, 0, 0.6));
  for (int i = 0; i < steps(world, 3.0); ++i) {
    world.step();
    for (std::size_t leg = 0; leg < 8; leg += 2) {
      const double angle = (leg < 4 ? -1.0 : 1.0) * rover.joint_position(leg);
      ASSERT_GT(angle, -1e-3);
      ASSERT_LT(angle, 0.682 + 1e-3);
    }
  }
}

TEST_P(Rover, HoldsOnASlope) {
  const double slope = 0.3;  // below mu = 0.8
  const auto plane = height_grid(65, 20.0, [&](double x, double) { return slope * x; });
  PhysicsWorld world(params(h()), silent());
  world.add_scenery({placement(static_model(heightmap(plane)))});
  const RoverShape shape;
  const Pose tilt = Pose::from_xyz_rpy({0, 0, 0}, {0, -std::atan(slope), 0});
  PhysicsModel& rover = world.add_model(rover_model(shape), tilt * at(0, 0, 0.1));
  drive(rover, shape, 0.0, 0.0);
  run(world, 3.0);
  const Eigen::Vector3d before = rover.pose().p;
  run(world, 5.0);
  EXPECT_LT((rover.pose().p - before).norm(), 5.0 * 1e-4);
}

TEST_P(Rover, PushesAgainstAStalkAndIsStopped) {
  PhysicsWorld world(params(h()), silent());
  add_ground(world);
  world.add_scenery({placement(static_model(Cylinder{0.015, 1.0}), at(1.0, 0.216, 0.5))});
  const RoverShape shape;
  PhysicsModel& rover = world.add_model(rover_model(shape), at(0, 0, 0.1));
  run(world, 0.5);
  drive(rover, shape, 5.0, 5.0);
  double farthest = 0.0;
  for (int i = 0; i < steps(world, 3.0); ++i) {
    world.step();
    farthest = std::max(farthest, rover.link_pose(2).p.x());
  }
  // The front left wheel meets the stalk: its hub stays a wheel's and a stalk's radius short of it,
  // or slides round it.
  const Eigen::Vector3d hub = rover.link_pose(2).p;
  EXPECT_GT((hub - Eigen::Vector3d(1.0, 0.216, hub.z())).norm(), 0.02);
  EXPECT_LT(rover.pose().p.norm(), 3.0);
}

}  // namespace
}  // namespace ardee::test
