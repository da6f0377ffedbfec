// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "ardee_sim/description/collision_bodies.h"

namespace ardee {
namespace {

Collision collision(const Geometry& geometry) {
  Collision made;
  made.geometry = geometry;
  made.X_LC.p.z() = 0.7;
  return made;
}

TEST(CollisionBodies, AreTransparentVisualsWhereTheCollisionsAre) {
  Model model;
  model.links.emplace_back().X_ML.p.x() = 2.0;
  model.links[0].visuals.resize(3);
  model.links[0].collisions = {collision(Cylinder{0.01, 1.4})};

  const auto bodies = collision_bodies(model);
  ASSERT_EQ(bodies->links.size(), 1u);
  EXPECT_EQ(bodies->links[0].X_ML.p.x(), 2.0);
  ASSERT_EQ(bodies->links[0].visuals.size(), 1u);
  const Visual& visual = bodies->links[0].visuals[0];
  EXPECT_EQ(visual.X_LV.p.z(), 0.7);
  EXPECT_GT(visual.transparency, 0.0);
  EXPECT_LT(visual.transparency, 1.0);
  EXPECT_FALSE(visual.cast_shadows);
  const Cylinder& shown = std::get<Cylinder>(visual.geometry);
  EXPECT_GT(shown.radius_m, 0.01);  // so that a visual of the same size shows through
  EXPECT_LT(shown.radius_m, 0.011);
}

TEST(CollisionBodies, LackGroundsAndMeshesThatAreVisible) {
  Mesh stone;
  stone.file = std::make_shared<MeshFile>();
  Mesh other;
  other.file = std::make_shared<MeshFile>();
  Model model;
  Link& link = model.links.emplace_back();
  link.visuals.emplace_back().geometry = stone;
  link.collisions = {collision(Plane{}), collision(Heightmap{}), collision(stone)};
  EXPECT_TRUE(collision_bodies(model)->links.empty());
  link.collisions.push_back(collision(other));
  ASSERT_EQ(collision_bodies(model)->links.size(), 1u);
  EXPECT_EQ(std::get<Mesh>(collision_bodies(model)->links[0].visuals.at(0).geometry).file,
            other.file);
}

}  // namespace
}  // namespace ardee
