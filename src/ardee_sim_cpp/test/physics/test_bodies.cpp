// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "models.h"

namespace ardee::test {
using namespace physics;
namespace {

class Bodies : public testing::TestWithParam<double> {
 protected:
  double h() const { return GetParam(); }
};

INSTANTIATE_TEST_SUITE_P(Steps, Bodies, testing::Values(0.001, 0.005));

TEST_P(Bodies, FreeFallIsSemiImplicitEuler) {
  PhysicsWorld world(params(h()), silent());
  PhysicsModel& body = world.add_model(box_model(2.0, {0.1, 0.2, 0.3}), at(0, 0, 100));
  run(world, 2.0);
  const double n = steps(world, 2.0), t = 2.0;
  EXPECT_NEAR(body.pose().p.z(), 100 - kGravity * h() * h() * n * (n + 1) / 2, 1e-9);
  EXPECT_NEAR(body.pose().p.z(), 100 - kGravity * t * t / 2, kGravity * h() * t / 2 * 1.001);
  EXPECT_NEAR(body.link_twist(0).linear.z(), -kGravity * t, 1e-9);
}

TEST_P(Bodies, BoxComesToDeadRest) {
  PhysicsWorld world(params(h()), silent());
  add_ground(world);
  PhysicsModel& body = world.add_model(box_model(2.0, {0.4, 0.3, 0.2}), at(0, 0, 0.15));
  run(world, 2.0);
  const Pose before = body.pose();
  run(world, 5.0);
  const Pose after = body.pose();
  EXPECT_LT((after.p - before.p).norm(), 1e-6);
  EXPECT_LT(after.q.angularDistance(before.q), 1e-6);
  EXPECT_LT(body.link_twist(0).linear.norm(), 1e-6);
  EXPECT_NEAR(after.p.z(), 0.1, 0.0011);
}

double slope_drift(double h, double mu, double angle, double duration_s, double settle_s) {
  PhysicsWorld world(params(h), silent());
  const Pose tilt = Pose::from_xyz_rpy({0, 0, 0}, {0, angle, 0});
  Surface surface;
  surface.mu = surface.mu2 = mu;
  world.add_scenery({placement(static_model(Plane{}, surface), tilt)});
  PhysicsModel& body =
      world.add_model(box_model(3.0, {0.4, 0.3, 0.2}, surface), tilt * at(0, 0, 0.1));
  run(world, settle_s);
  const Eigen::Vector3d before = body.pose().p;
  run(world, duration_s);
  return (body.pose().p - before).norm();
}

TEST_P(Bodies, BoxHoldsBelowTheFrictionAngle) {
  const double mu = 0.6;
  for (const double part : {0.5, 0.9, 0.97}) {
    const double drift_m = slope_drift(h(), mu, std::atan(part * mu), 5.0, 1.0);
    EXPECT_LT(drift_m, 5.0 * 1e-4) << "slope at " << part << " of the friction limit";
  }
}

TEST_P(Bodies, BoxSlidesAboveTheFrictionAngle) {
  const double mu = 0.4, angle = std::atan(1.2 * mu), t = 1.0;
  PhysicsWorld world(params(h()), silent());
  const Pose tilt = Pose::from_xyz_rpy({0, 0, 0}, {0, angle, 0});
  Surface surface;
  surface.mu = surface.mu2 = mu;
  world.add_scenery({placement(static_model(Plane{}, surface), tilt)});
  PhysicsModel& body =
      world.add_model(box_model(3.0, {0.4, 0.3, 0.1}, surface), tilt * at(0, 0, 0.0495));
  run(world, 0.2);
  const double v0 = body.link_twist(0).linear.norm();
  run(world, t);
  const double expected = kGravity * (std::sin(angle) - mu * std::cos(angle));
  EXPECT_NEAR((body.link_twist(0).linear.norm() - v0) / t, expected, 0.02 * expected);
}

TEST_P(Bodies, WrenchMovesAsNewtonSays) {
  PhysicsParams weightless = params(h());
  weightless.gravity_m_per_s2.setZero();
  PhysicsWorld world(weightless, silent());
  PhysicsModel& body = world.add_model(box_model(2.0, {0.1, 0.2, 0.3}), Pose{});
  const int n = steps(world, 1.0);
  for (int i = 0; i < n; ++i)
    body.apply_wrench(0, {3, 0, 0}, body.pose().p, {0, 0, 0}), world.step();
  EXPECT_NEAR(body.link_twist(0).linear.x(), 3.0 / 2.0, 1e-9);
  world.step();
  EXPECT_NEAR(body.link_twist(0).linear.x(), 3.0 / 2.0, 1e-9) << "a wrench acts for one step";
  const double izz = 2.0 / 12.0 * (0.1 * 0.1 + 0.2 * 0.2);
  body.apply_wrench(0, {0, 0, 0}, {0, 0, 0}, {0, 0, 0.5});
  world.step();
  EXPECT_NEAR(body.link_twist(0).angular.z(), 0.5 * h() / izz, 1e-9);
}

TEST_P(Bodies, BallBouncesByItsRestitution) {
  PhysicsWorld world(params(h()), silent());
  Surface bouncy;
  bouncy.restitution = 0.8;
  bouncy.bounce_threshold_m_per_s = 0.1;
  add_ground(world, bouncy);
  PhysicsModel& ball = world.add_model(sphere_model(1.0, 0.1, bouncy), at(0, 0, 1.1));
  double before = 0.0, v = 0.0;
  for (int i = 0; i < steps(world, 2.0) && v <= 0.0; ++i) {
    before = v;
    world.step();
    v = ball.link_twist(0).linear.z();
  }
  EXPECT_NEAR(v, -0.8 * before, 0.02 + kGravity * h());
  EXPECT_NEAR(before, -std::sqrt(2 * kGravity * 1.0), 0.06 + kGravity * h());
}

TEST_P(Bodies, SoftContactSinksByWeightOverStiffness) {
  PhysicsParams soft = params(h());
  soft.contact_surface_layer_m = 0.0;
  PhysicsWorld world(soft, silent());
  Surface spring;
  spring.kp_n_per_m = 2e4;
  spring.kd_n_s_per_m = 50.0;
  add_ground(world, spring);
  PhysicsModel& ball = world.add_model(sphere_model(3.0, 0.1, spring), at(0, 0, 0.1));
  run(world, 5.0);
  EXPECT_NEAR(0.1 - ball.pose().p.z(), 3.0 * kGravity / 1e4, 1e-5);  // two springs in series
}

TEST_P(Bodies, DecayTakesItsShareOfTheVelocityInEachStep) {
  PhysicsParams weightless = params(h());
  weightless.gravity_m_per_s2.setZero();
  auto description = box_model(2.0, {0.2, 0.2, 0.2});
  description->links[0].linear_decay = 0.1;
  description->links[0].angular_decay = 0.2;
  PhysicsWorld world(weightless, silent());
  PhysicsModel& body = world.add_model(description, Pose{});
  body.set_twist({{1, 0, 0}, {0, 0, 1}});
  for (int i = 0; i < 10; ++i) world.step();
  EXPECT_NEAR(body.link_twist(0).linear.x(), std::pow(0.9, 10), 1e-12);
  EXPECT_NEAR(body.link_twist(0).angular.z(), std::pow(0.8, 10), 1e-12);
  // ODE disables bodies below 0.01 m/s and rad/s.
  body.set_twist({{0.0099, 0, 0}, {0, 0, 0.0099}});
  for (int i = 0; i < 10; ++i) world.step();
  EXPECT_NEAR(body.link_twist(0).linear.x(), 0.0099, 1e-15);
  EXPECT_NEAR(body.link_twist(0).angular.z(), 0.0099, 1e-15);
}

TEST_P(Bodies, EachPartOfABodyLosesItsOwnShareOfTheMomentum) {
  auto description = box_model(2.0, {0.2, 0.2, 0.2});
  Link sail = link("sail", box_inertial(1.0, {0.2, 0.2, 0.2}));
  sail.linear_decay = 0.3;
  description->links.push_back(sail);
  Joint joint;
  joint.name = "fixed";
  joint.parent = "box";
  joint.child = "sail";
  description->joints.push_back(joint);
  PhysicsParams weightless = params(h());
  weightless.gravity_m_per_s2.setZero();
  PhysicsWorld world(weightless, silent());
  PhysicsModel& body = world.add_model(description, Pose{});
  body.set_twist({{1, 0, 0}, {0, 0, 0}});
  world.step();
  EXPECT_NEAR(body.link_twist(0).linear.x(), 1.0 - 0.3 / 3.0, 1e-12);
}

}  // namespace
}  // namespace ardee::test
