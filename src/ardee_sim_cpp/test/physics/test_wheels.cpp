// SPDX-License-Identifier: MIT
// Tests that wide wheels without springs roll on their whole width.
#include <gtest/gtest.h>

#include "joints.h"

namespace ardee::test {
using namespace physics;
namespace {

constexpr double kRadius_m = 0.1;
constexpr double kHalfTrack_m = 0.2;

struct Tread {
  double width_m = 0.08;
  double kp_n_per_m = 1e12;
  bool friction_cone = true;
  int max_contacts = 10;
  double mass_left_m = 0.0;  // the hull's centre of mass
  Geometry foot = Sphere{kRadius_m};
};

/// Returns a hull on two driven wheels and a sliding foot behind. Joints: left, right.
std::shared_ptr<Model> differential_drive(const Tread& tread) {
  auto robot = model(link("hull", box_inertial(4.0, {0.4, 0.3, 0.1})));
  Surface slippery;
  slippery.mu = slippery.mu2 = 0.0;
  robot->links[0].collisions.push_back(collision(tread.foot, slippery));
  robot->links[0].collisions[0].X_LC.p = {-0.3, 0, 0};
  robot->links[0].inertial->X_LI.p = {-0.05, tread.mass_left_m, 0};
  for (const double side : {1.0, -1.0}) {
    Link wheel = link(side > 0 ? "left" : "right", wheel_inertial(0.5, 0.0025));
    wheel.X_ML.p = {0, side * kHalfTrack_m, 0};
    Surface rubber;
    rubber.kp_n_per_m = tread.kp_n_per_m;
    rubber.friction_cone = tread.friction_cone;
    rubber.max_contacts = tread.max_contacts;
    wheel.collisions.push_back(collision(Cylinder{kRadius_m, tread.width_m}, rubber));
    wheel.collisions[0].X_LC = Pose::from_xyz_rpy({0, 0, 0}, {M_PI / 2, 0, 0});
    robot->links.push_back(wheel);
    Joint joint;
    joint.name = wheel.name;
    joint.type = JointType::kContinuous;
    joint.parent = "hull";
    joint.child = wheel.name;
    joint.axis.axis = {0, 1, 0};
    robot->joints.push_back(joint);
  }
  return robot;
}

/// Returns the mean yaw rate [rad/s] at these speeds of the left and right rim.
double yaw_rate(PhysicsWorld& world, PhysicsModel& robot, double left_m_per_s,
                double right_m_per_s) {
  robot.set_joint_motor(0, left_m_per_s / kRadius_m, 20.0);
  robot.set_joint_motor(1, right_m_per_s / kRadius_m, 20.0);
  run(world, 1.0);
  constexpr double kWatched_s = 2.0;
  double yaw = 0.0;
  double before = rpy_from_quaternion(robot.pose().q).z();
  for (int i = 0; i < steps(world, kWatched_s); ++i) {
    world.step();
    const double now = rpy_from_quaternion(robot.pose().q).z();
    yaw += std::remainder(now - before, 2.0 * M_PI);
    before = now;
  }
  return yaw / kWatched_s;
}

constexpr double kYaw_rad_per_s = 0.8;

/// Checks a robot's turns on flat ground, on the spot and while it goes forward.
void expect_turns(const Tread& tread, const Geometry& ground, double step_s,
                  double tolerance = 0.01) {
  for (const double forward : {0.0, 0.3}) {
    PhysicsWorld world(params(step_s), silent());
    world.add_scenery({placement(static_model(ground))});
    PhysicsModel& robot = world.add_model(differential_drive(tread), at(0.13, 0.07, kRadius_m));
    run(world, 0.5);
    const double rim = kYaw_rad_per_s * kHalfTrack_m;
    const double rate = yaw_rate(world, robot, forward - rim, forward + rim);
    EXPECT_NEAR(rate, kYaw_rad_per_s, tolerance * kYaw_rad_per_s)
        << "ground " << ground.index() << ", kp " << tread.kp_n_per_m << ", cone "
        << tread.friction_cone << ", forward " << forward << ", contacts " << tread.max_contacts;
  }
}

TEST(Wheels, WideOnesTurnARobotByTheirMiddlesOnEachGround) {
  const auto flat = height_grid(41, 8.0, [](double, double) { return 0.0; });
  Tread tread;
  for (const Geometry& ground : {Geometry(Plane{}), Geometry(Box{{8, 8, 0.02}}), heightmap(flat)}) {
    for (const double kp : {1e6, 1e9, 1e12}) {
      tread.kp_n_per_m = kp;
      for (const bool cone : {true, false}) {
        tread.friction_cone = cone;
        expect_turns(tread, ground, 0.001);
      }
    }
  }
}

TEST(Wheels, OnAMeshTheyDoSoWithinTheAccuracyOfItsContacts) {
  Tread tread;
  tread.kp_n_per_m = 1e6;
  expect_turns(tread, mesh_square(16, 8.0), 0.001, 0.03);
}

TEST(Wheels, TheyAreAsStiffAsTheirEnds) {
  // The 5 kg rest on two wheels and a foot, the centre of mass 0.05 m and the foot 0.3 m behind the
  // axle: the wheels carry 5/6 of the hull and themselves, on two springs each, in series with the
  // ground's.
  Tread tread;
  tread.kp_n_per_m = 1e5;
  for (const int max_contacts : {2, 10}) {
    tread.max_contacts = max_contacts;
    PhysicsWorld world(params(0.001), silent());
    add_ground(world);
    PhysicsModel& robot = world.add_model(differential_drive(tread), at(0, 0, kRadius_m - 0.001));
    run(world, 3.0);
    const double sinks_m = (4.0 * 5.0 / 6.0 + 1.0) * kGravity / 4.0 / 1e5;
    EXPECT_NEAR(kRadius_m - robot.pose().p.z(), 0.001 + sinks_m, 0.02 * sinks_m) << max_contacts;
  }
}

TEST(Wheels, TheirMiddleCountsWhereFewContactsAreWanted) {
  const auto flat = height_grid(41, 8.0, [](double, double) { return 0.0; });
  Tread tread;
  for (const Geometry& ground : {Geometry(Plane{}), heightmap(flat)}) {
    for (const int max_contacts : {1, 2, 3}) {
      tread.max_contacts = max_contacts;
      expect_turns(tread, ground, 0.001);
    }
  }
}

TEST(Wheels, AHardSquareFootBesideThemLeavesThemOnTheirMiddles) {
  Tread tread;
  tread.foot = Box{{0.1, 0.1, 2 * kRadius_m}};
  for (const double kp : {1e6, 1e12}) {
    tread.kp_n_per_m = kp;
    expect_turns(tread, Plane{}, 0.001);
  }
}

TEST(Wheels, UnevenLoadsAndLongStepsLeaveThemOnTheirMiddles) {
  Tread tread;
  tread.mass_left_m = 0.06;
  for (const double kp : {1e6, 1e12}) {
    tread.kp_n_per_m = kp;
    for (const double step_s : {0.001, 0.005}) expect_turns(tread, Plane{}, step_s);
  }
}

TEST(Wheels, ASpinningWheelOfATurningRobotDoesNotLeanOut) {
  PhysicsWorld world(weightless(0.001), silent());
  PhysicsModel& robot = world.add_model(differential_drive({}), Pose{});
  robot.set_joint_motor(0, 20.0, 1e3);
  robot.set_joint_motor(1, 20.0, 1e3);
  for (int i = 0; i < 1000; ++i) {
    robot.set_twist({{0, 0, 0}, {0, 0, 2}});  // all links alike: the next step spins up the wheels
    world.step();
    const Eigen::Vector3d axle = robot.pose().q * Eigen::Vector3d::UnitY();
    const Eigen::Vector3d wheel = robot.link_pose(1).q * Eigen::Vector3d::UnitY();
    ASSERT_LT((wheel - axle).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace ardee::test
