// SPDX-License-Identifier: MIT
// Wide wheels without give roll on their whole width.
#include <gtest/gtest.h>

#include "joints.h"

namespace ardee::test {
namespace {

constexpr double kRadius_m = 0.1;
constexpr double kHalfTrack_m = 0.2;

struct Tread {
  double width_m = 0.08;
  double kp_n_per_m = 1e12;
  bool friction_cone = true;
  int max_contacts = 10;
};

/// A hull on two driven wheels and a sliding foot behind. Joints: left, right.
std::shared_ptr<Model> differential_drive(const Tread& tread) {
  auto robot = model(link("hull", box_inertial(4.0, {0.4, 0.3, 0.1})));
  Surface slippery;
  slippery.mu = slippery.mu2 = 0.0;
  robot->links[0].collisions.push_back(collision(Sphere{kRadius_m}, slippery));
  robot->links[0].collisions[0].X_LC.p = {-0.3, 0, 0};
  robot->links[0].inertial->X_LI.p = {-0.05, 0, 0};
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

/// Mean rate of turn (rad/s) at so much speed of the left and right rim.
double yaw_rate(PhysicsWorld& world, PhysicsModel& robot, double left_m_per_s, double right_m_per_s) {
  robot.set_joint_motor(0, left_m_per_s / kRadius_m, 20.0);
  robot.set_joint_motor(1, right_m_per_s / kRadius_m, 20.0);
  run(world, 1.0);
  double yaw = 0.0;
  double before = rpy_from_quaternion(robot.pose().q).z();
  for (int i = 0; i < steps(world, 3.0); ++i) {
    world.step();
    const double now = rpy_from_quaternion(robot.pose().q).z();
    yaw += std::remainder(now - before, 2.0 * M_PI);
    before = now;
  }
  return yaw / 3.0;
}

TEST(Wheels, WideOnesTurnARobotByTheirMiddles) {
  const auto flat = height_grid(41, 8.0, [](double, double) { return 0.0; });
  const Geometry grounds[] = {Plane{}, Box{{8, 8, 0.02}}, heightmap(flat)};
  for (const Geometry& ground : grounds) {
    for (const double kp : {1e6, 1e9, 1e12}) {
      for (const bool cone : {true, false}) {
        for (const double forward : {0.0, 0.3}) {
          PhysicsWorld world(params(0.001), silent());
          world.add_scenery({placement(static_model(ground))});
          Tread tread;
          tread.kp_n_per_m = kp;
          tread.friction_cone = cone;
          PhysicsModel& robot = world.add_model(differential_drive(tread), at(0.13, 0.07, 0.1));
          run(world, 0.5);
          const double rim = 0.8 * kHalfTrack_m;
          const double rate = yaw_rate(world, robot, forward - rim, forward + rim);
          printf("ground %zu kp %g cone %d forward %g: rate %.4f contacts %zu\n", ground.index(), kp, cone, forward, rate, world.stats().contacts);
          EXPECT_NEAR(rate, 0.8, 0.012) << "ground " << ground.index() << ", kp " << kp << ", cone "
                                        << cone << ", forward " << forward;
        }
      }
    }
  }
}

TEST(Wheels, Debug) {
  for (const double z : {0.1, 0.09899, 0.0985}) for (const double kp : {1e6,1e7,1e8,1e9,1e12}) for (double settle : {0.5, 5.0}) {
          PhysicsWorld world(params(0.001), silent());
          add_ground(world);
          Tread tread;
          tread.kp_n_per_m = kp;
          PhysicsModel& robot = world.add_model(differential_drive(tread), at(0.13, 0.07, z));
          run(world, settle);
          const double rim = 0.8 * kHalfTrack_m;
          const double rate = yaw_rate(world, robot, - rim, rim);
          printf("z %g kp %g settle %g rate %.4f contacts %zu z %.3g roll %.3g wheel %.3g %.3g\n", z, kp, settle, rate, world.stats().contacts, robot.pose().p.z()-.1, rpy_from_quaternion(robot.pose().q).x(), (robot.link_pose(1).q*Eigen::Vector3d::UnitY()).z(), (robot.link_pose(2).q*Eigen::Vector3d::UnitY()).z());
  }
}

}  // namespace
}  // namespace ardee::test
