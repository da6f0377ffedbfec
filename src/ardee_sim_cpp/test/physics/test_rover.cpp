// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "rover.h"

namespace ardee::test {
using namespace physics;
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
  // Wheels roll freely, so the ground pushes straight up: the spring's torque is the load times the
  // hub's lever about the leg's joint, less the torque of the leg's own weight. The lever grows as
  // the leg turns.
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
  for (const bool cone : {false, true}) {
    PhysicsWorld world(params(h()), silent());
    add_ground(world);
    RoverShape shape;
    shape.friction_cone = cone;
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
    // Without skidding, wheels at +-omega r over half the track would turn the robot at omega r /
    // (track / 2); they do skid.
    const double bound = 4.0 * 0.097 / shape.half_track_m;
    EXPECT_LT(rate, bound);
    EXPECT_GT(rate, 0.3 * bound);
    EXPECT_LT((rover.pose().p - start.p).norm(), 0.05);
  }
}

/// Returns the moment and the lateral force on a skid-steering robot that turns in place, as shares
/// of the available friction: both vanish in a steady turn by Coulomb's cone. `load_front`: share
/// of the weight; tread: speed of the wheels' rims (m/s); center_x: the turn's centre, in the body
/// (m).
Eigen::Vector2d turn_balance(const RoverShape& shape, double load_front, double tread, double rate,
                             double center_x) {
  Eigen::Vector2d sum(0, 0);
  for (const double end : {1.0, -1.0}) {
    const double load = end > 0 ? load_front : 1.0 - load_front;
    const double lever = end * shape.half_base_m - center_x;
    const Eigen::Vector2d slip(tread - rate * shape.half_track_m, rate * lever);
    const Eigen::Vector2d force = load * slip.normalized();
    sum += Eigen::Vector2d(force.x() * shape.half_track_m - force.y() * lever, force.y());
  }
  return sum;
}

TEST_P(Rover, TurnsAboutItsMiddleWithAFrictionCone) {
  for (const double forward : {0.0, 0.02}) {
    PhysicsWorld world(params(h()), silent());
    add_ground(world);
    RoverShape shape;
    shape.legs = false;
    shape.friction_cone = true;
    shape.mass_forward_m = forward;
    PhysicsModel& rover = world.add_model(rover_model(shape), at(0, 0, 0.1));
    run(world, 1.0);
    drive(rover, shape, -4.0, 4.0);
    run(world, 2.0);
    // the mean over a while: the wheels' treads make it tremble
    double rate = 0.0;
    double side = 0.0;
    const int count = steps(world, 2.0);
    for (int i = 0; i < count; ++i) {
      world.step();
      const Twist twist = rover.link_twist(0);
      rate += twist.angular.z() / count;
      side += (rover.pose().q.conjugate() * twist.linear).y() / count;
    }
    const double b = shape.half_base_m;
    const double c = shape.half_track_m;
    const double tread = 4.0 * shape.wheel_radius_m;
    const double wheels_kg = 2.0;
    const double load_front = 0.5 + 0.5 * forward * shape.mass_kg / (shape.mass_kg + wheels_kg) / b;
    if (forward == 0.0) {
      EXPECT_NEAR(rate, tread * c / (b * b + c * c), 0.03 * rate);
      EXPECT_NEAR(side, 0.0, 0.005 * rate);
    }
    const double center_x = -side / rate;
    const Eigen::Vector2d balance = turn_balance(shape, load_front, tread, rate, center_x);
    EXPECT_NEAR(balance.x(), 0.0, 0.01) << "rate " << rate << " centre " << center_x;
    EXPECT_NEAR(balance.y(), 0.0, 0.03) << "rate " << rate << " centre " << center_x;
    EXPECT_LT(std::abs(center_x), 0.4 * b);  // the friction pyramid's centre is at b
  }
}

TEST_P(Rover, TurnsWithItsWeightToOneSide) {
  // The dimensions are those of a Husky: wheels, track, wheelbase; its weight is 7 cm to the right.
  // With the friction pyramid, whose axes slide independently, the left wheels would slip and the
  // robot would drive straight on.
  struct Case {
    bool pyramid;
    Eigen::Vector3d fdir1;
  };
  for (const Case& friction :
       {Case{true, {0, 0, 1}}, Case{false, {0, 0, 1}}, Case{false, {0, 0, 0}}}) {
    PhysicsWorld world(params(h()), silent());
    add_ground(world);
    RoverShape shape;
    shape.fdir1 = friction.fdir1;
    if (friction.pyramid) shape.friction_cone = false;
    shape.legs = false;
    shape.wheel_radius_m = 0.1651;
    shape.wheel_width_m = 0.1143;
    shape.half_track_m = 0.2854;
    shape.half_base_m = 0.256;
    shape.mass_kg = 46.0;
    shape.mass_left_m = -0.085;
    shape.mu = 1.0;
    PhysicsModel& rover = world.add_model(rover_model(shape), at(0, 0, 0.17));
    run(world, 1.0);
    drive(rover, shape, -1.7, 1.7, 35.0);
    run(world, 2.0);
    const double yaw = rpy_from_quaternion(rover.pose().q).z();
    run(world, 2.0);
    const double rate = std::remainder(rpy_from_quaternion(rover.pose().q).z() - yaw, 2 * M_PI) / 2;
    const double b = shape.half_base_m, c = shape.half_track_m;
    // The factor of an evenly loaded robot (Rover.TurnsAboutItsMiddleWithAFrictionCone); the
    // maker's nominal factor is 0.53.
    const double even = 1.7 * shape.wheel_radius_m * c / (b * b + c * c);
    if (friction.pyramid) {
      EXPECT_LT(rate, 0.2 * even);
    } else {
      EXPECT_NEAR(rate, even, 0.2 * even);
    }
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
  for (const bool cone : {false, true}) {
    const double slope = 0.3;  // below mu = 0.8
    const auto plane = height_grid(65, 20.0, [&](double x, double) { return slope * x; });
    PhysicsWorld world(params(h()), silent());
    world.add_scenery({placement(static_model(heightmap(plane)))});
    RoverShape shape;
    shape.friction_cone = cone;
    const Pose tilt = Pose::from_xyz_rpy({0, 0, 0}, {0, -std::atan(slope), 0});
    PhysicsModel& rover = world.add_model(rover_model(shape), tilt * at(0, 0, 0.1));
    drive(rover, shape, 0.0, 0.0);
    run(world, 3.0);
    const Eigen::Vector3d before = rover.pose().p;
    run(world, 5.0);
    EXPECT_LT((rover.pose().p - before).norm(), 5.0 * 1e-4);
  }
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
  // The front left wheel hits the stalk: its hub stays away by the radii of wheel and stalk, or
  // slides round it.
  const Eigen::Vector3d hub = rover.link_pose(2).p;
  EXPECT_GT((hub - Eigen::Vector3d(1.0, 0.216, hub.z())).norm(), 0.02);
  EXPECT_LT(rover.pose().p.norm(), 3.0);
}

}  // namespace
}  // namespace ardee::test
