// SPDX-License-Identifier: MIT
// Tests of moving models, ids, removal and refusals.
#include <gtest/gtest.h>

#include "scenes.h"

namespace ardee::test {
using namespace raycast;
namespace {

using Eigen::Vector3d;

Pose at(double x, double y, double z) { return {{x, y, z}, Eigen::Quaterniond::Identity()}; }

/// Returns two links: a body of two boxes and a wheel.
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

/// Boxes of 1 m stand 2 m apart along y, each seen straight along x.
TEST(Models, ManyThatStayAreMetWhereTheyAre) {
  constexpr std::uint32_t kCount = 40;
  TestScene scene(SceneKind::kCollision);
  const auto box = model_of(Box{{1, 1, 1}});
  const auto y = [](std::uint32_t k) { return 2.0 * k; };
  const auto range_m = [&](std::uint32_t k) { return scene.one({0, y(k), 0}, {1, 0, 0}).range_m; };
  for (std::uint32_t k = 0; k < kCount; ++k) scene.scene.add_model(k, box);
  for (int time = 0; time < 30; ++time) {
    for (std::uint32_t k = 0; k < kCount; ++k) {
      const double settling_m = 1e-3 * (time % 2);
      scene.scene.set_link_poses(k, {at(3 + settling_m, y(k), 0)});
    }
    for (std::uint32_t k = 0; k < kCount; ++k) {
      ASSERT_FLOAT_EQ(range_m(k), time % 2 == 0 ? 2.5f : 2.501f) << k << " at " << time;
    }
  }
  scene.scene.set_link_poses(7, {at(3.01, y(7), 0)});
  scene.scene.set_link_poses(8, {at(5, y(8), 0)});
  scene.scene.set_link_poses(9, {at(3, y(9), 50)});
  scene.scene.set_link_poses(10, {at(1.5, y(11), 0)});
  EXPECT_FLOAT_EQ(range_m(7), 2.51f);
  EXPECT_FLOAT_EQ(range_m(8), 4.5f);
  EXPECT_EQ(range_m(9), kInfinity);
  EXPECT_EQ(range_m(10), kInfinity);
  EXPECT_FLOAT_EQ(range_m(11), 1.0f);
  scene.scene.remove_model(12);
  scene.scene.remove_model(8);
  EXPECT_EQ(range_m(12), kInfinity);
  EXPECT_EQ(range_m(8), kInfinity);
  EXPECT_FLOAT_EQ(range_m(7), 2.51f);
  for (int time = 0; time < 30; ++time) EXPECT_FLOAT_EQ(range_m(20), 2.501f);
  for (std::uint32_t k = 0; k < kCount; ++k) {
    if (k != 8 && k != 12) scene.scene.remove_model(k);
  }
  EXPECT_EQ(range_m(20), kInfinity);
}

TEST(Models, SceneryIsRemovedWhole) {
  for (const bool flatten : {true, false}) {
    RayOptions options;
    options.local_scenes = flatten;
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
    options.local_scenes = flatten;
    options.local_scene_radius_m = 2.0;
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
    EXPECT_EQ(scene.scene.local_scene_triangles() > 0, flatten);
  }
}

/// A camera in its housing looks along x, with a picture of 64 x 64 pixels and 90 degrees, at an
/// arm of its robot before a wall: pixels at most 3.5 off the middle, 32 a metre at 1 m, see the
/// arm's face of 0.1 m at 0.45 m.
TEST(Models, LinksOfTheCamerasOwnRobotAreInItsPicture) {
  constexpr int kSide_px = 64;
  const auto carrier = model_of(Box{{0.08, 0.08, 0.08}});
  for (int k = 0; k < 2; ++k) {
    Link link = carrier->links[0];
    link.name = k == 0 ? "arm" : "mast";
    link.visuals[0].geometry = Box{{0.1, 0.1, k == 0 ? 0.1 : 1.0}};
    carrier->links.push_back(link);
  }
  const auto wall = model_of(mesh_of({box_mesh("wall", {1.0f, 20.0f, 20.0f})}));
  TestScene test(SceneKind::kVisual, {}, 0, {placed(wall, at(3.5, 0, 0))});
  test.scene.add_model(5, carrier);
  for (const bool in_sight : {true, false}) {
    const Pose arm = in_sight ? at(0.5, 0, 0) : at(0.5, 0.7, 0);
    test.scene.set_link_poses(5, {at(0, 0, 0), arm, at(-0.3, 0, 0.2)});
    test.scene.prepare({Vector3d::Zero()}, true);
    std::vector<PrimaryRayPacket> blocks(kSide_px * kSide_px / PrimaryRayPacket::kRays);
    const auto slope = [](std::size_t px) {
      return (static_cast<float>(px) + 0.5f) / (kSide_px / 2) - 1.0f;
    };
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      for (std::size_t i = 0; i < PrimaryRayPacket::kRays; ++i) {
        const std::size_t x = k % (kSide_px / 4) * 4 + i % 4;
        const std::size_t y = k / (kSide_px / 4) * 4 + i / 4;
        const auto ray = static_cast<int>(i);
        blocks[k].set_direction(ray, Eigen::Vector3f(1, slope(x), slope(y)).normalized());
        blocks[k].near_m[i] = 0.08f;
        blocks[k].far_m[i] = 100.0f;
      }
    }
    test.scene.pictures().trace_primary(Vector3d::Zero(), blocks.data(), blocks.size());
    int of_arm = 0;
    for (const PrimaryRayPacket& block : blocks) {
      for (int i = 0; i < PrimaryRayPacket::kRays; ++i) {
        const Eigen::Vector3f way = block.direction_W(i);
        const float aside = std::max(std::abs(way.y()), std::abs(way.z())) / way.x();
        const bool sees_arm = in_sight && aside * 0.45f < 0.05f;
        of_arm += sees_arm ? 1 : 0;
        EXPECT_EQ((block.surface[i] & PrimaryRayPacket::kOutside) != 0, sees_arm);
        EXPECT_NEAR(block.range_m[i], (sees_arm ? 0.45f : 3.0f) / way.x(), 1e-5f);
      }
    }
    EXPECT_EQ(of_arm, in_sight ? 8 * 8 : 0);
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
