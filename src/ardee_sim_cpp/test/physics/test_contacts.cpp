// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "joints.h"
#include "rover.h"

namespace ardee::test {
using namespace physics;
namespace {

class Contacts : public testing::TestWithParam<double> {
 protected:
  double h() const { return GetParam(); }
};

INSTANTIATE_TEST_SUITE_P(Steps, Contacts, testing::Values(0.001, 0.005));

TEST_P(Contacts, EveryShapeRestsOnEveryGround) {
  const auto flat = height_grid(41, 8.0, [](double, double) { return 0.0; });
  const Geometry grounds[] = {Plane{}, Box{{8, 8, 1e-3}}, mesh_square(16, 8.0), heightmap(flat)};
  const Geometry shapes[] = {Box{{0.2, 0.2, 0.2}}, Sphere{0.1}, Cylinder{0.1, 0.2}};
  for (std::size_t g = 0; g < 4; ++g) {
    for (std::size_t s = 0; s < 3; ++s) {
      PhysicsWorld world(params(h()), silent());
      world.add_scenery({placement(static_model(grounds[g]))});
      auto description = box_model(2.0, {0.2, 0.2, 0.2});
      description->links[0].collisions[0].geometry = shapes[s];
      PhysicsModel& body = world.add_model(description, at(0.13, 0.07, 0.12));
      run(world, 2.0);
      const Pose before = body.pose();
      run(world, 2.0);
      EXPECT_NEAR(before.p.z(), 0.1, 0.0025) << "ground " << g << ", shape " << s;
      EXPECT_LT((body.pose().p - before.p).norm(), 1e-4) << "ground " << g << ", shape " << s;
    }
  }
}

TEST_P(Contacts, MeshRestsOnAHeightmapAndAPlane) {
  // A tetrahedron with its base down.
  auto file = std::make_shared<MeshFile>();
  SubMesh part;
  part.vertices = {{0.2f, 0, 0}, {-0.1f, 0.17f, 0}, {-0.1f, -0.17f, 0}, {0, 0, 0.3f}};
  part.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  file->parts.push_back(part);
  Mesh mesh;
  mesh.file = file;
  mesh.scale = {2, 2, 1};
  const auto flat = height_grid(41, 8.0, [](double, double) { return 0.2; });
  PhysicsWorld world(params(h()), silent());
  world.add_scenery({placement(static_model(heightmap(flat)))});
  auto description = box_model(2.0, {0.2, 0.2, 0.2});
  description->links[0].inertial->X_LI.p = {0, 0, 0.1};
  description->links[0].collisions[0].geometry = mesh;
  PhysicsModel& body = world.add_model(description, at(0, 0, 0.25));
  run(world, 3.0);
  EXPECT_NEAR(body.pose().p.z(), 0.2, 0.0025);
  EXPECT_LT(body.link_twist(0).linear.norm(), 1e-6);
  EXPECT_LT(body.pose().q.angularDistance(Eigen::Quaterniond::Identity()), 0.01);
}

TEST_P(Contacts, FrictionDirectionTurnsWithTheBody) {
  // The runner has no friction along the body's x, and much along its y.
  Surface runner;
  runner.mu = 0.0;
  runner.mu2 = 1.0;
  runner.fdir1 = {1, 0, 0};
  PhysicsWorld world(params(h()), silent());
  add_ground(world);
  const double yaw = 0.6;
  PhysicsModel& sledge = world.add_model(box_model(2, {0.4, 0.3, 0.1}, runner),
                                         Pose::from_xyz_rpy({0, 0, 0.0495}, {0, 0, yaw}));
  sledge.set_twist({{1, 0, 0}, {0, 0, 0}});
  run(world, 1.0);
  const Eigen::Vector3d v = sledge.pose().q.conjugate() * sledge.link_twist(0).linear;
  EXPECT_NEAR(v.x(), std::cos(yaw), 0.05);
  EXPECT_NEAR(v.y(), 0.0, 0.01);
}

TEST_P(Contacts, FrictionSlowsASlidingBodyAlikeInEachDirection) {
  for (const double direction : {0.0, 0.4, M_PI / 4}) {
    Surface rubber;
    rubber.mu = rubber.mu2 = 0.5;
    PhysicsWorld world(params(h()), silent());
    add_ground(world);
    PhysicsModel& box = world.add_model(box_model(2, {0.4, 0.4, 0.02}, rubber), at(0, 0, 0.0095));
    const Eigen::Vector3d along(std::cos(direction), std::sin(direction), 0);
    box.set_twist({4.0 * along, {0, 0, 0}});
    run(world, 0.5);
    const Eigen::Vector3d v = box.link_twist(0).linear;
    EXPECT_NEAR(v.dot(along), 4.0 - 0.5 * kGravity * 0.5, 0.05);
    EXPECT_NEAR(v.cross(along).norm(), 0.0, 0.05);
  }
}

TEST_P(Contacts, SlidingAlongAFreeAxisTakesNoGripFromTheOther) {
  Surface runner;
  runner.mu = 0.0;
  runner.mu2 = 1.0;
  runner.fdir1 = {1, 0, 0};
  PhysicsWorld world(params(h()), silent());
  add_ground(world);
  PhysicsModel& sledge = world.add_model(box_model(2, {0.4, 0.3, 0.02}, runner), at(0, 0, 0.0095));
  sledge.set_twist({{5, 0.5, 0}, {0, 0, 0}});
  run(world, 0.1);  // v / (mu g) = 0.05 s
  EXPECT_NEAR(sledge.link_twist(0).linear.x(), 5.0, 0.05);
  EXPECT_NEAR(sledge.link_twist(0).linear.y(), 0.0, 0.02);
}

TEST_P(Contacts, SelfCollisionOnlyWhereAskedAndNeverAcrossAJoint) {
  for (const bool wanted : {false, true}) {
    auto description = box_model(1, {0.2, 0.2, 0.2});
    description->self_collide = wanted;
    const double xs[] = {0.25, 0.38};
    for (int i = 0; i < 2; ++i) {
      Link other = link("link" + std::to_string(i), box_inertial(1, {0.2, 0.2, 0.2}));
      other.X_ML.p = {xs[i], 0, 0};
      other.collisions.push_back(collision(Box{{0.2, 0.2, 0.2}}));
      description->links.push_back(other);
      Joint joint;
      joint.name = "joint" + std::to_string(i);
      joint.type = JointType::kRevolute;
      joint.parent = i == 0 ? "box" : "link0";
      joint.child = other.name;
      description->joints.push_back(joint);
    }
    description->links[2].collisions[0].X_LC.p = {-0.23, 0, 0};  // into the first link
    PhysicsWorld world(weightless(h()), silent());
    world.add_model(description, Pose{});
    world.step();
    EXPECT_EQ(world.stats().contacts > 0, wanted);
  }
}

TEST_P(Contacts, TwoRoversApartAreEachSolvedDirectly) {
  PhysicsWorld world(params(h()), silent());
  add_ground(world);
  PhysicsModel& first = world.add_model(rover_model(), at(0, 0, 0.1));
  PhysicsModel& second = world.add_model(rover_model(), at(0, 3, 0.1));
  const RoverShape shape;
  drive(first, shape, 3.0, 3.0);
  run(world, 2.0);
  EXPECT_TRUE(world.stats().solved_directly);
  EXPECT_GT(first.pose().p.x(), 0.4);
  EXPECT_LT((second.pose().p.head<2>() - Eigen::Vector2d(0, 3)).norm(), 1e-3);
}

TEST_P(Contacts, RoversPushOneAnother) {
  PhysicsWorld world(params(h()), silent());
  add_ground(world);
  const RoverShape shape;
  PhysicsModel& pusher = world.add_model(rover_model(shape), at(0, 0, 0.1));
  PhysicsModel& pushed = world.add_model(rover_model(shape), at(0.7, 0, 0.1));
  drive(pusher, shape, 4.0, 4.0);
  run(world, 3.0);
  EXPECT_GT(pushed.pose().p.x(), 1.0) << "its wheels coast";
  EXPECT_GT(pushed.pose().p.x() - pusher.pose().p.x(), 0.45);
}

TEST_P(Contacts, RestitutionThresholdLeavesSlowImpactsDead) {
  Surface surface;
  surface.restitution = 0.9;
  surface.bounce_threshold_m_per_s = 2.0;
  PhysicsWorld world(params(h()), silent());
  add_ground(world, surface);
  PhysicsModel& ball = world.add_model(sphere_model(1, 0.1, surface), at(0, 0, 0.2));
  double highest_v = 0.0;
  for (int i = 0; i < steps(world, 1.0); ++i) {
    world.step();
    highest_v = std::max(highest_v, ball.link_twist(0).linear.z());
  }
  EXPECT_LT(highest_v, 0.05);
}

}  // namespace
}  // namespace ardee::test
