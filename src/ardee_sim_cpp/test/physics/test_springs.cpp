// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <complex>

#include "joints.h"

namespace ardee::test {
using namespace physics;
namespace {

class Springs : public testing::TestWithParam<double> {
 protected:
  double h() const { return GetParam(); }
};

INSTANTIATE_TEST_SUITE_P(Steps, Springs, testing::Values(0.001, 0.005));

/// Returns a root z of a spring and damper under implicit Euler: (1 + h c / I + h^2 k / I) z^2 - (2
/// + h c / I) z + 1 = 0.
std::complex<double> implicit_root(double stiffness, double damping, double moment, double step_s) {
  const std::complex<double> a =
      1.0 + step_s * damping / moment + step_s * step_s * stiffness / moment;
  const std::complex<double> b = 2.0 + step_s * damping / moment;
  return (b + std::sqrt(b * b - 4.0 * a)) / (2.0 * a);
}

PhysicsModel& add_sprung(PhysicsWorld& world, double moment, const JointSpring& spring,
                         JointType type = JointType::kRevolute) {
  PhysicsModel& body = world.add_model(
      jointed_model(type, wheel_inertial(moment, moment), axis_along({0, 0, 1})), Pose{});
  body.set_joint_spring(0, spring);
  return body;
}

TEST_P(Springs, SwingsWithItsPeriodAndDecay) {
  for (const JointType type : {JointType::kRevolute, JointType::kPrismatic}) {
    const double moment = 0.05, stiffness = 2.0, damping = 0.01;
    PhysicsWorld world(weightless(h()), silent());
    PhysicsModel& body = add_sprung(world, moment, {stiffness, damping, 0.0}, type);
    body.set_joint_position(0, 0.1);
    const std::complex<double> z = implicit_root(stiffness, damping, moment, h());
    // This solves the recurrence with x(0) = x(-1) = 0.1 (at rest).
    const std::complex<double> weight = (0.1 - 0.1 / std::conj(z)) / (1.0 / z - 1.0 / std::conj(z));
    double crossing = 0.0, previous = 0.1;
    int crossings = 0;
    for (int i = 1; i <= steps(world, 4.0); ++i) {
      world.step();
      const double x = body.joint_position(0);
      EXPECT_NEAR(x, 2.0 * (weight * std::pow(z, i)).real(), 2e-6);
      if (previous > 0.0 && x <= 0.0 && crossings++ == 0) crossing = i * h();
      previous = x;
    }
    const double omega = std::sqrt(stiffness / moment - std::pow(damping / moment / 2.0, 2));
    const double lag = std::atan(damping / moment / 2.0 / omega);
    EXPECT_NEAR(crossing, (M_PI / 2.0 + lag) / omega, 2.0 * h());
    EXPECT_NEAR(std::arg(z) / h(), omega, 0.002 * omega + 5.0 * h() * h() * omega * omega);
  }
}

TEST_P(Springs, StiffSpringOnALightLegIsStable) {
  const double moment = 0.004;
  PhysicsWorld world(weightless(h()), silent());
  PhysicsModel& body = add_sprung(world, moment, {100.0, 1.0, 0.1});
  body.set_joint_position(0, 0.5);
  double previous = 0.4;
  for (int i = 0; i < steps(world, 1.0); ++i) {
    world.step();
    const double error = std::abs(body.joint_position(0) - 0.1);
    EXPECT_LE(error, 0.4);
    if (i % steps(world, 0.2) == steps(world, 0.2) - 1) {
      EXPECT_LT(error, 0.2 * previous + 1e-9);
      previous = error;
    }
  }
  EXPECT_NEAR(body.joint_position(0), 0.1, 1e-6);
  EXPECT_NEAR(body.joint_velocity(0), 0.0, 1e-6);
}

TEST_P(Springs, DeflectsByLoadOverStiffness) {
  PhysicsWorld world(weightless(h()), silent());
  PhysicsModel& body = add_sprung(world, 0.004, {100.0, 1.0, -0.2});
  for (int i = 0; i < steps(world, 2.0); ++i) {
    body.apply_joint_effort(0, 7.0);
    world.step();
  }
  EXPECT_NEAR(body.joint_position(0), -0.2 + 7.0 / 100.0, 1e-9);
}

TEST_P(Springs, LimitsHoldUnderLoadAndSpring) {
  PhysicsWorld world(weightless(h()), silent());
  PhysicsModel& body = add_sprung(world, 0.004, {100.0, 1.0, 0.0});
  body.set_joint_limits(0, -0.3, 0.05);
  double lowest = 0.0, highest = 0.0;
  const auto push = [&](double effort, double duration_s) {
    for (int i = 0; i < steps(world, duration_s); ++i) {
      body.apply_joint_effort(0, effort);
      world.step();
      lowest = std::min(lowest, body.joint_position(0));
      highest = std::max(highest, body.joint_position(0));
    }
  };
  push(60.0, 1.0);
  EXPECT_NEAR(body.joint_position(0), 0.05, 1e-4);
  push(-60.0, 1.0);
  EXPECT_NEAR(body.joint_position(0), -0.3, 1e-4);
  EXPECT_GT(lowest, -0.3 - 1e-6);
  EXPECT_LT(highest, 0.05 + 1e-6);
  push(0.0, 1.0);
  EXPECT_NEAR(body.joint_position(0), 0.0, 1e-6) << "the spring brings it back";
}

TEST_P(Springs, SpringReferenceBeyondAStopRestsOnTheStop) {
  PhysicsWorld world(params(h()), silent());
  PhysicsModel& body = add_sprung(world, 0.004, {100.0, 1.0, 0.5});
  body.set_joint_limits(0, -0.1, 0.2);
  run(world, 1.0);
  const double before = body.joint_position(0);
  EXPECT_NEAR(before, 0.2, 1e-4);
  run(world, 1.0);
  EXPECT_NEAR(body.joint_position(0), before, 1e-6);
}

TEST_P(Springs, MotorWorksAgainstTheSpring) {
  PhysicsWorld world(weightless(h()), silent());
  PhysicsModel& body = add_sprung(world, 0.004, {10.0, 0.1, 0.0});
  body.set_joint_motor(0, 1.0, 2.0);
  run(world, 2.0);
  EXPECT_NEAR(body.joint_position(0), 2.0 / 10.0, 1e-4) << "the motor's effort balances the spring";
}

TEST_P(Springs, ChangingTheStepKeepsTheSpring) {
  PhysicsWorld world(weightless(h()), silent());
  PhysicsModel& body = add_sprung(world, 0.004, {100.0, 1.0, 0.0});
  world.set_params(weightless(0.002));
  for (int i = 0; i < 1000; ++i) {
    body.apply_joint_effort(0, 5.0);
    world.step();
  }
  EXPECT_NEAR(body.joint_position(0), 0.05, 1e-9);
}

}  // namespace
}  // namespace ardee::test
