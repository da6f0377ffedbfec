// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "scenes.h"

namespace ardee::test {
using namespace raycast;
namespace {

SurfaceInteraction trace(const RayScene& scene, const Eigen::Vector3d& from,
                         const Eigen::Vector3d& way) {
  const SceneRay ray{from, way.normalized(), 100.0};
  SurfaceInteraction point;
  scene.pictures().trace(&ray, 1, &point);
  return point;
}

SurfaceInteraction trace_approximately(const RayScene& scene, const Eigen::Vector3d& from,
                                       const Eigen::Vector3d& way) {
  const SceneRay ray{from, way.normalized(), 100.0};
  SurfaceInteraction point;
  scene.pictures().trace_approximately(&ray, 1, &point);
  return point;
}

bool shadow(const RayScene& scene, const Eigen::Vector3d& from, const Eigen::Vector3d& way,
            double reach_m = 100.0) {
  const SceneRay ray{from, way.normalized(), reach_m};
  bool found = false;
  scene.pictures().find_shadows(&ray, 1, &found);
  return found;
}

/// Returns a sheet of 2 m x 1 m in the yz plane, facing +x, textured once, its normals leaning to
/// +z.
Mesh sheet() {
  SubMesh part;
  part.vertices = {{0, -1, 0}, {0, 1, 0}, {0, 1, 1}, {0, -1, 1}};
  part.normals.assign(4, Eigen::Vector3f(1, 0, 1).normalized());
  part.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  part.triangles = {{0, 1, 2}, {0, 2, 3}};
  part.material = 0;
  Mesh mesh = mesh_of({part});
  auto file = std::make_shared<MeshFile>(*mesh.file);
  file->materials.push_back(two_sided());
  mesh.file = file;
  return mesh;
}

TEST(SurfaceInteraction, KnowsPlaceOnTheTextureNormalAndMaterial) {
  const auto model = model_of(sheet());
  TestScene scene(SceneKind::kVisual);
  scene.scene.add_scenery(7, {placed(model, {{5, 0, 0}, Eigen::Quaterniond::Identity()}, 2.0, 3)});
  scene.scene.prepare({{0, 0, 0}});
  // The ray comes from behind; the sheet is twice as large: y from -2 to 2, z from 0 to 2.
  const SurfaceInteraction point = trace(scene.scene, {0, 1, 0.5}, {1, 0, 0});
  ASSERT_TRUE(point.met());
  EXPECT_NEAR(point.range_m, 5.0, 1e-12);
  EXPECT_EQ(point.entity, 7u);
  EXPECT_EQ(point.label, 3u);
  EXPECT_EQ(point.material,
            &std::get<Mesh>(model->links[0].visuals[0].geometry).file->materials[0]);
  EXPECT_NEAR(point.uv.x(), 0.75, 1e-9);
  EXPECT_NEAR(point.uv.y(), 0.25, 1e-9);
  EXPECT_NEAR(point.uv_per_m, 1.0 / std::sqrt(4.0 * 2.0), 1e-9);
  EXPECT_NEAR(point.normal_W.x(), -1.0, 1e-9);
  EXPECT_NEAR(point.smooth_normal_W.x(), -std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(point.smooth_normal_W.z(), -std::sqrt(0.5), 1e-6);
  scene.scene.prepare({{0, 0, 0}}, true);
  const SurfaceInteraction quick = trace_approximately(scene.scene, {0, 1, 0.5}, {1, 0, 0});
  EXPECT_NEAR(quick.range_m, 5.0, 1e-5);
  EXPECT_EQ(quick.entity, 7u);
  EXPECT_EQ(quick.label, 3u);
  EXPECT_EQ(quick.material, point.material);
  EXPECT_EQ(quick.visual, point.visual);
  EXPECT_TRUE(quick.two_sided);
  EXPECT_NEAR((quick.uv - point.uv).norm(), 0.0, 1e-6);
  EXPECT_NEAR(quick.uv_per_m, point.uv_per_m, 1e-6);
  EXPECT_NEAR((quick.normal_W - point.normal_W).norm(), 0.0, 1e-6);
  EXPECT_NEAR((quick.smooth_normal_W - point.smooth_normal_W).norm(), 0.0, 1e-6);
}

TEST(SurfaceInteraction, TerrainIsSmooth) {
  // z = 0.1 x^2 sampled each metre: the slope between samples is interpolated.
  auto grid = std::make_shared<HeightGrid>();
  grid->columns = grid->rows = 11;
  grid->size_m = {10, 10};
  for (int k = 0; k < 121; ++k) {
    const auto x = static_cast<float>(k % 11 - 5);
    grid->heights_m.push_back(0.1f * x * x);
  }
  Heightmap map;
  map.grid = grid;
  TestScene scene(SceneKind::kVisual);
  scene.scene.add_scenery(0, {placed(model_of(map))});
  scene.scene.prepare({{0, 0, 5}});
  const SurfaceInteraction point = trace(scene.scene, {1.5, 0.3, 5}, {0, 0, -1});
  EXPECT_NEAR(-point.smooth_normal_W.x() / point.smooth_normal_W.z(), 0.3, 1e-6);
  EXPECT_NEAR(point.point_S.x(), 1.5, 1e-9);
  scene.scene.prepare({{0, 0, 5}}, true);
  const SurfaceInteraction quick = trace_approximately(scene.scene, {1.5, 0.3, 5}, {0, 0, -1});
  // Interpolated normals instead of slopes give (sin a + sin b) / (cos a + cos b), tan a = 0.2, tan
  // b = 0.4.
  EXPECT_NEAR(-quick.smooth_normal_W.x() / quick.smooth_normal_W.z(), 0.29727, 1e-4);
  EXPECT_NEAR((quick.point_S - point.point_S).norm(), 0.0, 1e-5);
  EXPECT_EQ(quick.visual, point.visual);
}

TEST(SurfaceInteraction, ShadowsAreCastFromBothSidesWithinReach) {
  auto model = model_of(sheet(), {}, Material{});
  TestScene scene(SceneKind::kVisual);
  scene.scene.add_scenery(0, {placed(model)});
  scene.scene.prepare({});
  for (const double side : {-1.0, 1.0}) {
    EXPECT_TRUE(shadow(scene.scene, {side, 0, 0.5}, {-side, 0, 0}));
    EXPECT_FALSE(shadow(scene.scene, {side, 0, 0.5}, {-side, 0, 0}, 0.99));
    EXPECT_FALSE(shadow(scene.scene, {side, 0, 1.5}, {-side, 0, 0}));
  }
  auto quiet = std::make_shared<Model>(*model);
  quiet->links[0].visuals[0].cast_shadows = false;
  TestScene without(SceneKind::kVisual);
  without.scene.add_scenery(0, {placed(quiet)});
  without.scene.prepare({});
  EXPECT_FALSE(shadow(without.scene, {1, 0, 0.5}, {-1, 0, 0}));
}

/// trace() and cast() hit the same points, in a local scene and beyond it.
TEST(SurfaceInteraction, AgreesWithTheSensorsRays) {
  std::vector<Placement> placements;
  for (int k = 0; k < 40; ++k) {
    const Pose pose = Pose::from_xyz_rpy({0.7 * (k % 8) - 2, 0.9 * (k / 8) - 2, 0.1 * (k % 3)},
                                         {0.1 * k, 0, 0.3 * k});
    placements.push_back(placed(model_of(sheet()), pose, 0.3));
  }
  TestScene scene(SceneKind::kVisual);
  scene.scene.add_scenery(0, placements);
  const RayPattern pattern = random_pattern(2000, 5);
  const Pose eye{{0.2, 0.1, 0.3}, Eigen::Quaterniond::Identity()};
  const std::vector<RayHit> hits = scene.cast(eye, pattern, 50.0f);
  int met = 0;
  for (std::size_t k = 0; k < hits.size(); ++k) {
    const SurfaceInteraction point =
        trace(scene.scene, eye.p, pattern.directions_S[k].cast<double>().normalized());
    ASSERT_EQ(point.entity, hits[k].entity);
    if (!point.met()) continue;
    ++met;
    EXPECT_FLOAT_EQ(static_cast<float>(point.range_m), hits[k].range_m);
    EXPECT_TRUE(shadow(scene.scene, eye.p, pattern.directions_S[k].cast<double>()));
  }
  EXPECT_GT(met, 200);
}

}  // namespace
}  // namespace ardee::test
