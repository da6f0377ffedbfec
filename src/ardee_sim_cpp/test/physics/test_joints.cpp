// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "joints.h"

namespace ardee::test {
using namespace physics;
namespace {

class Joints : public testing::TestWithParam<double> {
 protected:
  double h() const { return GetParam(); }
};

INSTANTIATE_TEST_SUITE_P(Steps, Joints, testing::Values(0.001, 0.005));

TEST_P(Joints, PositiveRotationTurnsTheChildAboutTheAxis) {
  // The joint's frame is turned against the child's, the child's against the model's.
  const Pose X_ML = Pose::from_xyz_rpy({0.3, -0.2, 0.5}, {0.4, 0.1, -0.7});
  auto description = jointed_model(JointType::kRevolute, wheel_inertial(1.0, 0.01),
                                   axis_along(Eigen::Vector3d(1, 2, -1).normalized()), X_ML);
  description->joints[0].X_CJ = Pose::from_xyz_rpy({0.1, 0.05, 0}, {0.2, 0.3, 0.1});
  PhysicsWorld world(weightless(h()), silent());
  const Pose X_WM = Pose::from_xyz_rpy({1, 2, 3}, {0.1, 0.2, 0.3});
  PhysicsModel& body = world.add_model(description, X_WM);
  EXPECT_NEAR(body.joint_position(0), 0.0, 1e-12);
  body.set_joint_position(0, 0.7);
  const Pose X_MJ = X_ML * description->joints[0].X_CJ;
  const Pose turn{{0, 0, 0},
                  Eigen::Quaterniond(Eigen::AngleAxisd(0.7, description->joints[0].axis.axis))};
  const Pose expected = X_WM * X_MJ * turn * description->joints[0].X_CJ.inverse();
  EXPECT_LT((body.link_pose(0).p - expected.p).norm(), 1e-9);
  EXPECT_LT(body.link_pose(0).q.angularDistance(expected.q), 1e-7);
  body.set_joint_motor(0, 2.0, 100.0);
  run(world, 0.1);
  EXPECT_NEAR(body.joint_velocity(0), 2.0, 1e-3);
  EXPECT_NEAR(body.joint_position(0), 0.9, 2e-3);
  const Eigen::Vector3d axis_W = (X_WM * X_MJ).q * description->joints[0].axis.axis;
  EXPECT_NEAR(body.link_twist(0).angular.dot(axis_W), 2.0, 1e-3);
}

TEST_P(Joints, ContinuousAngleCountsTurns) {
  PhysicsWorld world(weightless(h()), silent());
  PhysicsModel& body = world.add_model(
      jointed_model(JointType::kContinuous, wheel_inertial(1, 0.01), axis_along({0, 1, 0})),
      Pose{});
  body.set_joint_motor(0, -15.0, 1e3);
  run(world, 4.0);
  EXPECT_NEAR(body.joint_position(0), -15.0 * 4.0, 0.01);
  body.set_joint_position(0, 100.0);
  run(world, 1.0);
  EXPECT_NEAR(body.joint_position(0), 85.0, 0.01);
}

TEST_P(Joints, MotorAcceleratesByItsEffortAndStopsAtItsVelocity) {
  PhysicsWorld world(weightless(h()), silent());
  PhysicsModel& body = world.add_model(
      jointed_model(JointType::kContinuous, wheel_inertial(1, 0.02), axis_along({0, 0, 1})),
      Pose{});
  body.set_joint_motor(0, 10.0, 0.1);
  run(world, 1.0);
  EXPECT_NEAR(body.joint_velocity(0), 0.1 / 0.02, 1e-6);
  run(world, 2.0);
  EXPECT_NEAR(body.joint_velocity(0), 10.0, 1e-6);
  body.set_joint_motor(0, 0.0, 0.0);
  run(world, 1.0);
  EXPECT_NEAR(body.joint_velocity(0), 10.0, 1e-6) << "it coasts";
}

TEST_P(Joints, EffortOfTheDescriptionBoundsAppliedEffortsButNotTheMotor) {
  JointAxis axis = axis_along({0, 0, 1});
  axis.effort = 0.05;
  axis.velocity = 0.1;
  PhysicsWorld world(weightless(h()), silent());
  PhysicsModel& body =
      world.add_model(jointed_model(JointType::kContinuous, wheel_inertial(1, 0.02), axis), Pose{});
  body.set_joint_motor(0, 10.0, 0.1);
  run(world, 1.0);
  EXPECT_NEAR(body.joint_velocity(0), 0.1 / 0.02, 1e-6);
  body.apply_joint_effort(0, -100.0);
  body.set_joint_motor(0, 0.0, 0.0);
  world.step();
  EXPECT_NEAR(body.joint_velocity(0), 5.0 - 0.05 / 0.02 * h(), 1e-6);
}

TEST_P(Joints, DampingDecaysExponentially) {
  JointAxis axis = axis_along({1, 0, 0});
  axis.damping = 0.05;
  PhysicsWorld world(weightless(h()), silent());
  PhysicsModel& body =
      world.add_model(jointed_model(JointType::kContinuous, wheel_inertial(1, 0.02), axis), Pose{});
  body.set_twist({{0, 0, 0}, {8.0, 0, 0}});
  run(world, 1.0);
  // Implicit Euler: each step divides the rate by 1 + h c / I.
  const double discrete = 8.0 * std::pow(1.0 + h() * 0.05 / 0.02, -steps(world, 1.0));
  EXPECT_NEAR(body.joint_velocity(0), discrete, 1e-6);
  EXPECT_NEAR(body.joint_velocity(0), 8.0 * std::exp(-2.5), 8.0 * std::exp(-2.5) * 3.2 * h());
}

TEST_P(Joints, DryFrictionStopsAtAConstantRate) {
  JointAxis axis = axis_along({0, 0, 1});
  axis.friction = 0.04;
  PhysicsWorld world(weightless(h()), silent());
  PhysicsModel& body =
      world.add_model(jointed_model(JointType::kContinuous, wheel_inertial(1, 0.02), axis), Pose{});
  body.set_twist({{0, 0, 0}, {0, 0, 3.0}});
  run(world, 1.0);
  EXPECT_NEAR(body.joint_velocity(0), 3.0 - 0.04 / 0.02, 1e-6);
  run(world, 1.0);
  EXPECT_NEAR(body.joint_velocity(0), 0.0, 1e-9);
}

TEST_P(Joints, PrismaticSlidesAlongItsAxisBetweenItsStops) {
  JointAxis axis = axis_along({0, 0, 1});
  axis.lower = -0.2;
  axis.upper = 0.3;
  PhysicsWorld world(params(h()), silent());
  const Pose X_ML = Pose::from_xyz_rpy({0.5, 0, 0}, {0, 0, 0.3});
  PhysicsModel& body = world.add_model(
      jointed_model(JointType::kPrismatic, box_inertial(2, {0.1, 0.1, 0.1}), axis, X_ML), Pose{});
  body.set_joint_position(0, 0.1);
  EXPECT_NEAR(body.link_pose(0).p.z(), 0.1, 1e-12);
  run(world, 2.0);
  EXPECT_NEAR(body.joint_position(0), -0.2, 1e-4) << "it lies on its lower stop";
  EXPECT_NEAR(body.link_pose(0).p.z(), -0.2, 1e-4);
  body.set_joint_motor(0, 0.5, 1000.0);
  run(world, 0.4);
  EXPECT_NEAR(body.joint_velocity(0), 0.5, 1e-3);
  run(world, 2.0);
  EXPECT_NEAR(body.joint_position(0), 0.3, 1e-3) << "the motor pushes it against its upper stop";
  EXPECT_LT((body.link_pose(0).p - Eigen::Vector3d(0.5, 0, 0.3)).norm(), 2e-3);
}

TEST_P(Joints, BallHoldsItsAnchorAndLetsThePendulumSwing) {
  auto description = jointed_model(JointType::kBall, box_inertial(1, {0.02, 0.02, 0.02}), {});
  description->links[0].X_ML.p = {0.4, 0, 0};
  description->joints[0].X_CJ.p = {-0.4, 0, 0};
  PhysicsWorld world(params(h()), silent());
  PhysicsModel& body = world.add_model(description, Pose{});
  double lowest = 0.0, worst = 0.0;
  for (int i = 0; i < steps(world, 2.0); ++i) {
    world.step();
    lowest = std::min(lowest, body.link_pose(0).p.z());
    worst = std::max(worst, std::abs((body.link_pose(0) * Eigen::Vector3d(-0.4, 0, 0)).norm()));
  }
  EXPECT_NEAR(lowest, -0.4, 0.01);
  EXPECT_LT(worst, 0.002);
}

TEST_P(Joints, UniversalCountsItsFirstAxisInTheParent) {
  for (const JointType type : {JointType::kUniversal, JointType::kRevolute2}) {
    PhysicsWorld world(weightless(h()), silent());
    PhysicsModel& body = world.add_model(
        jointed_model(type, wheel_inertial(1, 0.01), axis_along({0, 0, 1})), Pose{});
    body.set_joint_motor(0, 0.5, 100.0);
    run(world, 1.0);
    EXPECT_NEAR(body.joint_position(0), 0.5, 5e-3);
    const double yaw = rpy_from_quaternion(body.link_pose(0).q).z();
    EXPECT_NEAR(yaw, body.joint_position(0), 1e-6);
    // The link turns freely about the second axis, y in the child, but not about x.
    body.set_joint_motor(0, 0.0, 100.0);
    const Eigen::Vector3d y = body.link_pose(0).q * Eigen::Vector3d::UnitY();
    for (int i = 0; i < steps(world, 0.2); ++i) {
      body.apply_wrench(0, {0, 0, 0}, {0, 0, 0}, 0.05 * y);
      world.step();
    }
    EXPECT_NEAR(body.link_twist(0).angular.dot(y), 0.05 * 0.2 / 0.01, 0.01);
    const Eigen::Vector3d z_turned = body.link_pose(0).q * Eigen::Vector3d::UnitY();
    EXPECT_NEAR(z_turned.z(), 0.0, 1e-3) << "the second axis stays level";
  }
}

TEST_P(Joints, Revolute2WheelIsDrivenAboutItsFirstAxisSteering) {
  auto description =
      jointed_model(JointType::kRevolute2, wheel_inertial(1, 0.01), axis_along({0, 0, 1}));
  description->joints[0].axis.lower = -0.3;
  description->joints[0].axis.upper = 0.3;
  PhysicsWorld world(weightless(h()), silent());
  PhysicsModel& body = world.add_model(description, Pose{});
  body.set_joint_motor(0, 1.0, 1.0);
  run(world, 1.0);
  EXPECT_NEAR(body.joint_position(0), 0.3, 1e-3);
  EXPECT_NEAR(rpy_from_quaternion(body.link_pose(0).q).z(), 0.3, 1e-3);
}

TEST_P(Joints, SettingAPositionMovesAllThatHangsOnIt) {
  auto description = std::make_shared<Model>();
  description->name = "arm";
  for (const char* name : {"base", "upper", "lower", "tip"}) {
    description->links.push_back(link(name, box_inertial(1, {0.1, 0.1, 0.1})));
    description->links.back().X_ML.p = {static_cast<double>(description->links.size() - 1), 0, 0};
  }
  description->canonical_link = "base";
  const char* names[] = {"base", "upper", "lower", "tip"};
  for (int i = 0; i < 3; ++i) {
    Joint joint;
    joint.name = std::string("joint") + names[i];
    joint.type = i == 2 ? JointType::kFixed : JointType::kRevolute;
    joint.parent = names[i];
    joint.child = names[i + 1];
    joint.axis.upper = 1.0;
    joint.axis.lower = -1.0;
    description->joints.push_back(joint);
  }
  PhysicsWorld world(weightless(h()), silent());
  PhysicsModel& body = world.add_model(description, Pose{});
  body.set_joint_position(0, 0.5);
  const Eigen::Vector3d out(std::cos(0.5), std::sin(0.5), 0);
  EXPECT_LT((body.link_pose(3).p - Eigen::Vector3d(1, 0, 0) - 2.0 * out).norm(), 1e-12);
  EXPECT_LT(body.link_pose(0).p.norm(), 1e-12);
  EXPECT_NEAR(body.joint_position(1), 0.0, 1e-12);
  body.set_joint_position(1, 7.0);
  EXPECT_NEAR(body.joint_position(1), 1.0, 1e-12) << "within its limits";
  body.set_state(at(0, 0, 5), {});
  EXPECT_NEAR(body.joint_position(1), 1.0, 1e-12);
  EXPECT_NEAR(body.link_pose(3).p.z(), 5.0, 1e-12);
}

/// Returns a wheel that steers about z and spins about an axis that leans 20 degrees out of the
/// plane.
std::shared_ptr<Model> leaning_wheel() {
  auto wheel = jointed_model(JointType::kRevolute2, wheel_inertial(1, 0.02), axis_along({0, 0, 1}));
  wheel->joints[0].axis2.axis = {0, std::cos(M_PI / 9), std::sin(M_PI / 9)};
  return wheel;
}

TEST_P(Joints, InclinedAxesDoNotShareTheirRates) {
  auto description = leaning_wheel();
  description->joints[0].axis.lower = description->joints[0].axis.upper = 0.0;
  PhysicsWorld world(weightless(h()), silent());
  PhysicsModel& wheel = world.add_model(description, Pose{});
  const Eigen::Vector3d spin = description->joints[0].axis2.axis;
  wheel.set_twist({{0, 0, 0}, 10.0 * spin});
  run(world, 0.2);
  EXPECT_NEAR(wheel.joint_velocity(0), 0.0, 1e-6) << "it spins and does not steer";
  EXPECT_LT((wheel.link_twist(0).angular - 10.0 * spin).norm(), 1e-4);
}

TEST_P(Joints, ADamperOfOneInclinedAxisDoesNotBrakeTheOther) {
  auto description = leaning_wheel();
  description->joints[0].axis.damping = 100.0;
  PhysicsWorld world(weightless(h()), silent());
  PhysicsModel& wheel = world.add_model(description, Pose{});
  wheel.set_twist({{0, 0, 0}, 10.0 * description->joints[0].axis2.axis});
  run(world, 0.5);
  EXPECT_NEAR(wheel.link_twist(0).angular.norm(), 10.0, 1e-3);
}

TEST_P(Joints, MotorsOfInclinedAxesReachTheirRates) {
  PhysicsWorld world(weightless(h()), silent());
  PhysicsModel& wheel = world.add_model(leaning_wheel(), Pose{});
  wheel.set_joint_motor(0, 0, {0.5, 100.0});
  wheel.set_joint_motor(0, 1, {4.0, 100.0});
  run(world, 1.0);
  EXPECT_NEAR(wheel.joint_velocity(0), 0.5, 1e-3);
  EXPECT_NEAR(wheel.joint_position(0), 0.5, 0.5 * 2 * h());
  const Eigen::Vector3d axis2 = wheel.link_pose(0).q * leaning_wheel()->joints[0].axis2.axis;
  const Eigen::Vector3d expected = 0.5 * Eigen::Vector3d::UnitZ() + 4.0 * axis2;
  EXPECT_LT((wheel.link_twist(0).angular - expected).norm(), 0.01);
}

TEST_P(Joints, NoEffortActsInTheDirectionOfAMotionBeyondTheLimitOfVelocity) {
  for (const JointType type : {JointType::kRevolute, JointType::kPrismatic}) {
    JointAxis axis = axis_along({0, 0, 1});
    axis.effort = 2.0;
    axis.velocity = 1.0;
    PhysicsWorld world(weightless(h()), silent());
    PhysicsModel& head = world.add_model(jointed_model(type, wheel_inertial(0.5, 0.5), axis), {});
    const auto push = [&](double effort, double duration_s) {
      for (int i = 0; i < steps(world, duration_s); ++i) {
        head.apply_joint_effort(0, effort);
        world.step();
      }
    };
    push(50.0, 0.1);
    EXPECT_NEAR(head.joint_velocity(0), 0.4, 1e-6) << "2 N m on 0.5 kg m^2";
    push(50.0, 1.9);
    EXPECT_NEAR(head.joint_velocity(0), 1.0, 4.0 * h() + 1e-6) << "at most a step too fast";
    push(-50.0, 0.25);
    EXPECT_NEAR(head.joint_velocity(0), 0.0, 4.0 * h() + 1e-6) << "it brakes all the same";
    push(-50.0, 2.0);
    EXPECT_NEAR(head.joint_velocity(0), -1.0, 4.0 * h() + 1e-6);
  }
}

}  // namespace
}  // namespace ardee::test
