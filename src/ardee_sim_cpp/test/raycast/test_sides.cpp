// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "scenes.h"

namespace ardee::test {
using namespace raycast;
namespace {

/// Returns a single quad facing +x.
Mesh quad() {
  SubMesh part;
  part.name = "quad";
  part.vertices = {{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}};
  part.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh_of({part});
}

class Sides : public ::testing::TestWithParam<bool> {
 protected:
  std::pair<bool, bool> front_and_back(SceneKind kind, const Geometry& geometry,
                                       std::optional<Material> material) {
    TestScene scene(kind, GetParam() ? RayOptions{} : instances_only());
    scene.scene.add_scenery(0, {placed(model_of(geometry, {}, std::move(material)))});
    return {std::isfinite(scene.one({2, 0.1, 0.2}, {-1, 0, 0}).range_m),
            std::isfinite(scene.one({-2, 0.1, 0.2}, {1, 0, 0}).range_m)};
  }
};
INSTANTIATE_TEST_SUITE_P(NearAndFar, Sides, ::testing::Bool());

TEST_P(Sides, OneSidedInTheVisualSceneOnly) {
  EXPECT_EQ(front_and_back(SceneKind::kVisual, quad(), std::nullopt), std::make_pair(true, false));
  EXPECT_EQ(front_and_back(SceneKind::kVisual, quad(), Material{}), std::make_pair(true, false));
  EXPECT_EQ(front_and_back(SceneKind::kVisual, quad(), two_sided()), std::make_pair(true, true));
  EXPECT_EQ(front_and_back(SceneKind::kCollision, quad(), Material{}), std::make_pair(true, true));
}

TEST_P(Sides, MaterialOfTheMeshFileCounts) {
  Mesh mesh = quad();
  auto file = std::make_shared<MeshFile>(*mesh.file);
  file->materials = {Material{}, two_sided()};
  file->parts[0].material = 1;
  mesh.file = file;
  EXPECT_EQ(front_and_back(SceneKind::kVisual, mesh, std::nullopt), std::make_pair(true, true));
  EXPECT_EQ(front_and_back(SceneKind::kVisual, mesh, Material{}), std::make_pair(true, false));
}

TEST_P(Sides, MirroredMeshKeepsItsOutside) {
  Mesh mesh = mesh_of({box_mesh("box", {1, 1, 1})});
  mesh.scale = {-1, 1, 1};
  TestScene scene(SceneKind::kVisual);
  scene.scene.add_scenery(0, {placed(model_of(mesh))});
  EXPECT_FLOAT_EQ(scene.one({2, 0.1, 0.2}, {-1, 0, 0}).range_m, 1.5f);
}

TEST_P(Sides, VolumesAreSeenThroughFromWithin) {
  for (const Geometry& geometry :
       {Geometry(Box{{2, 2, 2}}), Geometry(Sphere{1.0}), Geometry(Cylinder{1.0, 2.0}),
        Geometry(mesh_of({box_mesh("box", {2, 2, 2})}))}) {
    TestScene visual(SceneKind::kVisual, GetParam() ? RayOptions{} : instances_only());
    visual.scene.add_scenery(0, {placed(model_of(geometry))});
    EXPECT_EQ(visual.one({0, 0, 0}, {1, 0, 0}).range_m, kInfinity);
    EXPECT_FLOAT_EQ(visual.one({3, 0, 0}, {-1, 0, 0}).range_m, 2.0f);
    TestScene collision(SceneKind::kCollision, GetParam() ? RayOptions{} : instances_only());
    collision.scene.add_scenery(0, {placed(model_of(geometry))});
    const RayHit inside = collision.one({0, 0, 0}, {1, 0, 0});
    EXPECT_FLOAT_EQ(inside.range_m, 1.0f);
    EXPECT_FLOAT_EQ(inside.normal_W.x(), -1.0f);
  }
}

TEST_P(Sides, BehindAOneSidedSheetTheNextIsMet) {
  TestScene scene(SceneKind::kVisual, GetParam() ? RayOptions{} : instances_only());
  const Pose behind{{3, 0, 0}, Eigen::Quaterniond::Identity()};
  scene.scene.add_scenery(0, {placed(model_of(quad())), placed(model_of(Box{{1, 1, 1}}), behind)});
  const RayHit hit = scene.one({-2, 0.1, 0.2}, {1, 0, 0});
  EXPECT_FLOAT_EQ(hit.range_m, 4.5f);
  EXPECT_EQ(hit.entity, 1u);
}

/// Thesis Figure 4.14: the leaves of a plant are in the visual scene only, a box is in both.
TEST_P(Sides, ScenesDifferOnALeafyPlantAndAgreeOnABox) {
  auto plant = std::make_shared<Model>();
  plant->name = "plant";
  Link link;
  Visual leaf;
  leaf.geometry = quad();
  leaf.material = two_sided();
  link.visuals.push_back(leaf);
  Collision stem;
  stem.geometry = Cylinder{0.02, 2.0};
  link.collisions.push_back(stem);
  plant->links.push_back(link);
  const auto box = model_of(Box{{1, 1, 1}});
  const Pose far{{0, 5, 0}, Eigen::Quaterniond::Identity()};
  int differ = 0;
  std::vector<RayHit> hits[2];
  for (const SceneKind kind : {SceneKind::kVisual, SceneKind::kCollision}) {
    TestScene scene(kind, GetParam() ? RayOptions{} : instances_only());
    scene.scene.add_scenery(0, {placed(plant), placed(box, far)});
    hits[static_cast<int>(kind)] =
        scene.cast(Pose::from_xyz_rpy({-4, 2, 0}, {0, 0, 0}), fan(1081, -kPi / 2, kPi / 2), 30.0f);
  }
  int on_box = 0;
  for (std::size_t k = 0; k < hits[0].size(); ++k) {
    const bool is_box = hits[0][k].entity == 1 && hits[1][k].entity == 1;
    on_box += is_box ? 1 : 0;
    if (is_box) {
      EXPECT_EQ(hits[0][k].range_m, hits[1][k].range_m);
    }
    if (hits[0][k].range_m != hits[1][k].range_m) ++differ;
  }
  EXPECT_GT(on_box, 30);
  EXPECT_GT(differ, 60);
}

}  // namespace
}  // namespace ardee::test
