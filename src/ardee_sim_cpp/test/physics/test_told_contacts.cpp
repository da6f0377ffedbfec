// SPDX-License-Identifier: MIT
// Tests of reported contacts: their names, and the balance of their forces.
#include <gtest/gtest.h>

#include "models.h"

namespace ardee::test {
using namespace physics;
namespace {

using Eigen::Vector3d;

/// Returns a cube that does not sleep, and reports contacts at rest too.
std::shared_ptr<Model> sleepless_box(double mass_kg, double size_m) {
  auto made = box_model(mass_kg, {size_m, size_m, size_m});
  made->allow_auto_disable = false;
  return made;
}

/// Cube of 2 kg and 0.2 m at rest on a plane.
struct RestingCube {
  RestingCube() : world(params(0.001), silent()) {
    world.add_scenery({placement(static_model(Plane{}))}, "ground");
    cube = &world.add_model(sleepless_box(2.0, 0.2), at(0.3, 0, 0.1), "cube");
    run(world, 1.0);
  }
  void step() {
    world.want_contacts();
    world.step();
  }

  PhysicsWorld world;
  PhysicsModel* cube = nullptr;
};

TEST(ToldContacts, CarryTheWeightOfWhatRests) {
  RestingCube resting;
  EXPECT_TRUE(resting.world.contacts().empty());  // nobody has asked
  resting.step();
  const std::vector<Contact> contacts = resting.world.contacts();
  ASSERT_EQ(contacts.size(), resting.world.stats().contacts);
  ASSERT_EQ(contacts.size(), 4u);
  ForceTorque on_cube, on_ground;
  for (const Contact& contact : contacts) {
    EXPECT_EQ(contact.collision1, "cube::box::collision");
    EXPECT_EQ(contact.collision2, "ground::static::collision");
    EXPECT_NEAR(contact.normal.z(), 1.0, 1e-6);
    EXPECT_NEAR(std::abs(contact.position.x() - 0.3), 0.1, 1e-6);
    EXPECT_NEAR(std::abs(contact.position.y()), 0.1, 1e-6);
    EXPECT_GT(contact.depth_m, 0.0);
    EXPECT_LT(contact.depth_m, 0.0025);
    on_cube.force += contact.on1.force;
    on_cube.torque += contact.on1.torque;
    on_ground.force += contact.on2.force;
    on_ground.torque += contact.on2.torque;
  }
  const Vector3d weight(0, 0, 2.0 * kGravity);
  EXPECT_LT((on_cube.force - weight).norm(), 1e-3);
  EXPECT_LT(on_cube.torque.norm(), 1e-3);
  // The weight acts on the ground 0.3 m along x from its frame: (0.3, 0, 0) x (0, 0, -m g).
  EXPECT_LT((on_ground.force + weight).norm(), 1e-3);
  EXPECT_LT((on_ground.torque - Vector3d(0, 0.3 * weight.z(), 0)).norm(), 1e-3);
  resting.world.step();
  EXPECT_TRUE(resting.world.contacts().empty());
}

TEST(ToldContacts, ChangeNothingOfTheStep) {
  RestingCube asked, silent_one;
  const Twist push{{1.0, 0.5, 0}, {0, 0, 2}};
  asked.cube->set_twist(push);
  silent_one.cube->set_twist(push);
  for (int i = 0; i < 200; ++i) {
    asked.step();
    silent_one.world.step();
  }
  const Pose one = asked.cube->pose(), other = silent_one.cube->pose();
  EXPECT_EQ(one.p, other.p);
  EXPECT_EQ(one.q.coeffs(), other.q.coeffs());
}

TEST(ToldContacts, BetweenTwoThatMoveAreEqualAndOpposite) {
  RestingCube resting;
  resting.world.add_model(sleepless_box(1.0, 0.1), at(0.3, 0, 0.25), "small");
  run(resting.world, 1.0);
  resting.step();
  Vector3d on_cube(0, 0, 0), on_small(0, 0, 0);
  for (const Contact& contact : resting.world.contacts()) {
    if (contact.collision2 != "small::box::collision") continue;
    EXPECT_EQ(contact.collision1, "cube::box::collision");
    on_cube += contact.on1.force;
    on_small += contact.on2.force;
  }
  EXPECT_LT((on_small - Vector3d(0, 0, kGravity)).norm(), 1e-3);
  EXPECT_LT((on_cube + on_small).norm(), 1e-9);
}

TEST(ToldContacts, OfWhatCollidesWithoutContactHaveNoForce) {
  PhysicsWorld world(params(0.001), silent());
  Surface ghost;
  ghost.collide_without_contact = true;
  world.add_scenery({placement(static_model(Box{{1, 1, 1}}, ghost))}, "beam");
  PhysicsModel& cube = world.add_model(box_model(2.0, {0.2, 0.2, 0.2}), at(0, 0, 0.55), "cube");
  world.want_contacts();
  world.step();
  ASSERT_FALSE(world.contacts().empty());
  for (const Contact& contact : world.contacts()) EXPECT_TRUE(contact.on1.force.isZero());
  EXPECT_NEAR(cube.link_twist(0).linear.z(), -kGravity * 0.001, 1e-9);  // it falls
}

TEST(ToldContacts, NameTheModelWithinAModel) {
  auto plant = static_model(Box{{0.1, 0.1, 1}});
  auto field = std::make_shared<Model>();
  field->name = "field";
  field->is_static = true;
  for (int i = 0; i < 3; ++i) {
    Instance corn;
    corn.model = plant;
    corn.name = "corn_" + std::to_string(i);
    corn.pose = at(i, 0, 0);
    field->instances.push_back(corn);
  }
  Instance placed;
  placed.model = field;
  placed.name = "acre";
  PhysicsWorld world(params(0.001), silent());
  world.add_scenery(flatten_scenery(placed), placed.name, placement_names(placed));
  world.add_model(box_model(2.0, {0.2, 0.2, 0.2}), at(2, 0, 0.59), "cube");
  world.want_contacts();
  world.step();
  ASSERT_FALSE(world.contacts().empty());
  EXPECT_EQ(world.contacts()[0].collision2, "acre::corn_2::static::collision");
}

}  // namespace
}  // namespace ardee::test
