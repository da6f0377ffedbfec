// SPDX-License-Identifier: MIT
// Moving models, ids, removal and refusals.
#include <gtest/gtest.h>

#include "scenes.h"

namespace ardee::test {
namespace {

using Eigen::Vector3d;

Pose at(double x, double y, double z) { return {{x, y, z}, Eigen::Quaterniond::Identity()}; }

/// Two links: a body of two boxes and a wheel.
std::shared_ptr<Model> robot() {
  auto model = model_of(Box{{0.4, 0.4, 0.4}});
  model->name = "robot";
  Collision mast = model->links[0].collisions[0];
  mast.geometry = Box{{0.1, 0.1, 1.0}};
  mast.X_LC.p.z() = 0.7;
  mast.laser_retro = 9.0;
  model->links[0].collisions.push_back(mast);
  Link wheel;
  wheel.name = "wheel";
  wheel.X_ML.p.x() = 1.0;
  Collision round;
  round.geometry = Sphere{0.1};
  wheel.collisions.push_back(round);
  model->links.push_back(wheel);
  return model;
}

TEST(Models, OwnLinkIsLookedThrough) {
  TestScene scene(SceneKind::kCollision);
  scene.scene.add_model(5, robot());
  scene.scene.add_scenery(10, {placed(model_of(Box{{1, 1, 1}}), at(4, 0, 0))});
  scene.scene.set_link_poses(5, {at(0, 0, 0), at(1, 0, 0)});
  const Pose eye = at(0, 0, 0);
  const auto own = scene.cast(eye, fan(1, 0, 0), 30.0f, 5, 0).front();
  EXPECT_FLOAT_EQ(own.range_m, 0.9f);
  EXPECT_EQ(own.entity, 5u);
  EXPECT_EQ(own.link, 1u);
  const auto none = scene.cast(eye, fan(1, 0, 0), 30.0f).front();
  EXPECT_FLOAT_EQ(none.range_m, 0.2f);
  EXPECT_EQ(none.link, 0u);
  scene.scene.set_link_poses(5, {at(0, 0, 0), at(1, 3, 0)});
  EXPECT_FLOAT_EQ(scene.cast(eye, fan(1, 0, 0), 30.0f, 5, 0).front().range_m, 3.5f);
}

TEST(Models, ShapeAndRetroOfTheShapeMet) {
  TestScene scene(SceneKind::kCollision);
  scene.scene.add_model(5, robot());
  EXPECT_EQ(scene.one({-2, 0, 0.8}, {1, 0, 0}).range_m, kInfinity) << "met before it was placed";
  scene.scene.set_link_poses(5, {at(0, 0, 0), at(1, 0, 0)});
  const RayHit mast = scene.one({-2, 0, 0.8}, {1, 0, 0});
  EXPECT_FLOAT_EQ(mast.range_m, 1.95f);
  EXPECT_EQ(mast.shape, 1u);
  EXPECT_FLOAT_EQ(mast.laser_retro, 9.0f);
  EXPECT_FLOAT_EQ(scene.one({-2, 0, 0.1}, {1, 0, 0}).laser_retro, 5.0f);
}

TEST(Models, MovesAndTurns) {
  TestScene scene(SceneKind::kCollision);
  scene.scene.add_model(5, model_of(Box{{2, 1, 1}}));
  for (int k = 0; k < 20; ++k) {
    scene.scene.set_link_poses(5, {at(3 + k, 0, 0)});
    EXPECT_FLOAT_EQ(scene.one({0, 0, 0}, {1, 0, 0}).range_m, static_cast<float>(2 + k));
    scene.scene.set_link_poses(5, {Pose::from_xyz_rpy({3.0 + k, 0, 0}, {0, 0, kPi / 2})});
    EXPECT_FLOAT_EQ(scene.one({0, 0, 0}, {1, 0, 0}).range_m, static_cast<float>(2.5 + k));
  }
}

TEST(Models, TwoModelsAndRemoval) {
  TestScene scene(SceneKind::kCollision);
  scene.scene.add_model(1, model_of(Box{{1, 1, 1}}));
  scene.scene.add_model(2, model_of(Box{{1, 1, 1}}));
  scene.scene.set_link_poses(1, {at(3, 0, 0)});
  scene.scene.set_link_poses(2, {at(6, 0, 0)});
  EXPECT_EQ(scene.one({0, 0, 0}, {1, 0, 0}).entity, 1u);
  scene.scene.remove_model(1);
  EXPECT_EQ(scene.one({0, 0, 0}, {1, 0, 0}).entity, 2u);
  scene.scene.remove_model(2);
  EXPECT_EQ(scene.one({0, 0, 0}, {1, 0, 0}).range_m, kInfinity);
}

TEST(Models, SceneryIsRemovedWhole) {
  for (const bool flatten : {true, false}) {
    RayOptions options;
    options.flatten = flatten;
    TestScene scene(SceneKind::kCollision, options);
    const auto box = model_of(Box{{1, 1, 1}});
    scene.scene.add_scenery(0, {placed(box, at(3, 0, 0)), placed(box, at(5, 0, 0))});
    scene.scene.add_scenery(2, {placed(box, at(9, 0, 0)), placed(model_of(Plane{}), at(0, 0, -2))});
    EXPECT_FLOAT_EQ(scene.one({0, 0, 0}, {1, 0, 0}).range_m, 2.5f);
    scene.scene.remove_scenery(0);
    EXPECT_FLOAT_EQ(scene.one({0, 0, 0}, {1, 0, 0}).range_m, 8.5f);
    EXPECT_FLOAT_EQ(scene.one({0, 0, 0}, {0, 0, -1}).range_m, 2.0f);
    scene.scene.remove_scenery(2);
    EXPECT_EQ(scene.one({0, 0, 0}, {1, 0, 0}).range_m, kInfinity);
    EXPECT_EQ(scene.one({0, 0, 0}, {0, 0, -1}).range_m, kInfinity);
    scene.scene.add_scenery(0, {placed(box, at(4, 0, 0))});
    EXPECT_FLOAT_EQ(scene.one({0, 0, 0}, {1, 0, 0}).range_m, 3.5f);
  }
}

TEST(Models, IdsOfInstancesNearAndFar) {
  auto model = model_of(mesh_of({box_mesh("a", {0.2f, 0.2f, 0.2f})}));
  Link second = model->links[0];
  second.X_ML.p.z() = 1.0;
  second.visuals.insert(second.visuals.begin(), second.visuals[0]);
  second.visuals[0].X_LV.p.z() = 1.0;
  model->links.push_back(second);
  std::vector<Placement> placements;
  for (int k = 0; k < 40; ++k) {
    placements.push_back(placed(model, at(0.5 * k, 3, 0), 1.0, static_cast<std::uint32_t>(k % 3)));
  }
  for (const bool flatten : {true, false}) {
    RayOptions options;
    options.flatten = flatten;
    options.flattened_radius_m = 2.0;
    TestScene scene(SceneKind::kVisual, options);
    scene.scene.add_scenery(100, placements);
    for (std::uint32_t k = 0; k < 40; ++k) {
      for (const auto& [z, link, shape] :
           {std::make_tuple(0.0, 0u, 0u), std::make_tuple(1.0, 1u, 1u),
            std::make_tuple(2.0, 1u, 0u)}) {
        const RayHit hit = scene.one({0.5 * k, 0, z}, {0, 1, 0});
        EXPECT_FLOAT_EQ(hit.range_m, 2.9f);
        EXPECT_EQ(hit.entity, 100 + k);
        EXPECT_EQ(hit.link, link);
        EXPECT_EQ(hit.shape, shape);
        EXPECT_EQ(hit.label, k % 3);
        EXPECT_FLOAT_EQ(hit.laser_retro, 3.0f);
      }
    }
    EXPECT_EQ(scene.scene.flattened_triangles() > 0, flatten);
  }
}

TEST(Models, EmptySceneAndEmptyPattern) {
  TestScene scene(SceneKind::kVisual);
  EXPECT_EQ(scene.one({0, 0, 0}, {1, 0, 0}).range_m, kInfinity);
  EXPECT_TRUE(scene.cast(Pose{}, RayPattern{}).empty());
  scene.scene.add_scenery(0, {});
  scene.scene.add_scenery(1, {placed(std::make_shared<Model>())});
  EXPECT_EQ(scene.one({0, 0, 0}, {1, 0, 0}).range_m, kInfinity);
}

TEST(Models, BadInputIsRefusedAndNothingIsLeft) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto box = model_of(Box{{1, 1, 1}});
  TestScene scene(SceneKind::kCollision);
  EXPECT_THROW(scene.scene.add_scenery(0, {placed(box, at(3, 0, 0)), placed(box, at(nan, 0, 0))}),
               Error);
  EXPECT_THROW(scene.scene.add_scenery(0, {placed(box, at(1e30, 0, 0))}), Error);
  EXPECT_THROW(scene.scene.add_scenery(0, {placed(box, at(3, 0, 0), 0.0)}), Error);
  EXPECT_THROW(scene.scene.add_scenery(0, {placed(box, at(3, 0, 0), nan)}), Error);
  EXPECT_THROW(scene.scene.add_scenery(0, {placed(nullptr)}), Error);
  EXPECT_THROW(scene.scene.add_scenery(0, {placed(model_of(Sphere{nan}))}), Error);
  EXPECT_THROW(scene.scene.add_scenery(0, {placed(model_of(Mesh{}))}), Error);
  SubMesh broken = box_mesh("broken", {1, 1, 1});
  broken.triangles[3][1] = 8;
  EXPECT_THROW(scene.scene.add_scenery(0, {placed(model_of(mesh_of({broken})))}), Error);
  EXPECT_THROW(scene.scene.remove_scenery(0), Error);
  EXPECT_EQ(scene.one({0, 0, 0}, {1, 0, 0}).range_m, kInfinity);
  scene.scene.add_scenery(0, {placed(box, at(3, 0, 0)), placed(box, at(5, 0, 0))});
  EXPECT_THROW(scene.scene.add_scenery(1, {placed(box)}), Error);

  scene.scene.add_model(9, box);
  EXPECT_THROW(scene.scene.add_model(9, box), Error);
  EXPECT_THROW(scene.scene.set_link_poses(8, {Pose{}}), Error);
  EXPECT_THROW(scene.scene.set_link_poses(9, {}), Error);
  scene.scene.set_link_poses(9, {at(2, 0, 0)});
  EXPECT_THROW(scene.scene.set_link_poses(9, {at(1, nan, 0)}), Error);
  EXPECT_FLOAT_EQ(scene.one({0, 0, 0}, {1, 0, 0}).range_m, 1.5f);

  std::vector<RayHit> hits;
  const RayPattern ahead = fan(1, 0, 0);
  EXPECT_THROW(scene.scene.prepare({{0, nan, 0}}), Error);
  EXPECT_THROW(scene.scene.cast(at(0, 0, nan), ahead, 1, kNoEntity, 0, hits), Error);
  EXPECT_THROW(scene.scene.cast(Pose{}, ahead, -1, kNoEntity, 0, hits), Error);
  EXPECT_THROW(scene.scene.cast(Pose{}, {{{0, 0, 0}}}, 1, kNoEntity, 0, hits), Error);
  scene.scene.remove_scenery(0);
  EXPECT_THROW(scene.scene.cast(Pose{}, ahead, 1, kNoEntity, 0, hits), Error)
      << "prepare is missing";
}

}  // namespace
}  // namespace ardee::test
