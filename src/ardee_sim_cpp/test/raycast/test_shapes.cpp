// SPDX-License-Identifier: MIT
// Tests of ranges and normals against closed forms.
#include <gtest/gtest.h>

#include "scenes.h"

namespace ardee::test {
using namespace raycast;
namespace {

using Eigen::Vector3d;

/// Fixture for both ways to the same answer: local scenes and instances.
class Shapes : public ::testing::TestWithParam<bool> {
 protected:
  RayOptions options() const { return GetParam() ? RayOptions{} : instances_only(); }
  TestScene scene_with(const Geometry& geometry, const Pose& X_WM = {}, double scale = 1.0) {
    return {SceneKind::kCollision, options(), 7, {placed(model_of(geometry), X_WM, scale)}};
  }
};
INSTANTIATE_TEST_SUITE_P(NearAndFar, Shapes, ::testing::Bool());

void expect_normal(const RayHit& hit, const Vector3d& expected) {
  EXPECT_LT((hit.normal_W.cast<double>() - expected).norm(), 1e-6)
      << hit.normal_W.transpose() << " instead of " << expected.transpose();
}

TEST_P(Shapes, SphereRangeAndNormal) {
  TestScene scene = scene_with(Sphere{0.5}, {{3, 0, 0}, Eigen::Quaterniond::Identity()});
  EXPECT_FLOAT_EQ(scene.one({0, 0, 0}, {1, 0, 0}).range_m, 2.5f);
  // The ray is 0.3 m off centre: half the chord is 0.4 m.
  const RayHit hit = scene.one({0, 0.3, 0}, {1, 0, 0});
  EXPECT_FLOAT_EQ(hit.range_m, 2.6f);
  expect_normal(hit, {-0.8, 0.6, 0});
  EXPECT_EQ(scene.one({0, 0.5001, 0}, {1, 0, 0}).range_m, kInfinity);
  EXPECT_FLOAT_EQ(scene.one({3, 0, 0}, {0, 0, 1}).range_m, 0.5f);
}

TEST_P(Shapes, BoxRangeAndNormalFromATurnedSensor) {
  TestScene scene = scene_with(Box{{2, 4, 6}}, {{5, 0, 0}, Eigen::Quaterniond::Identity()});
  EXPECT_FLOAT_EQ(scene.one({0, 0, 0}, {1, 0, 0}).range_m, 4.0f);
  // The sensor's x axis points along the world's y: its beam at -90° is the world's x.
  const Pose turned = Pose::from_xyz_rpy({0, 1, 2}, {0, 0, kPi / 2});
  const RayHit hit = scene.cast(turned, fan(1, -kPi / 2, 0)).front();
  EXPECT_FLOAT_EQ(hit.range_m, 4.0f);
  expect_normal(hit, {-1, 0, 0});
  // The sensor is rolled and pitched, at 30° to the normal.
  const Pose pitched = Pose::from_xyz_rpy({0, 0, 0}, {0.7, kPi / 6, 0});
  EXPECT_NEAR(scene.cast(pitched, fan(1, 0, 0)).front().range_m, 4.0 / std::cos(kPi / 6), 1e-6);
}

TEST_P(Shapes, CylinderChordAndCap) {
  TestScene scene = scene_with(Cylinder{0.02, 1.0}, {{2, 0, 0.5}, Eigen::Quaterniond::Identity()});
  // A beam is at a distance h from the axis: half the chord is sqrt(r^2 - h^2).
  for (const double h : {0.0, 0.005, 0.012, 0.019}) {
    const RayHit hit = scene.one({0, h, 0.3}, {1, 0, 0});
    const double half = std::sqrt(0.02 * 0.02 - h * h);
    EXPECT_NEAR(hit.range_m, 2.0 - half, 1e-7);
    expect_normal(hit, Vector3d(-half, h, 0) / 0.02);
  }
  EXPECT_EQ(scene.one({0, 0.0201, 0.3}, {1, 0, 0}).range_m, kInfinity);
  EXPECT_EQ(scene.one({0, 0, 1.001}, {1, 0, 0}).range_m, kInfinity);
  const RayHit cap = scene.one({2.01, 0, 3}, {0, 0, -1});
  EXPECT_FLOAT_EQ(cap.range_m, 2.0f);
  expect_normal(cap, {0, 0, 1});
}

TEST_P(Shapes, CollisionPlaneIsInfiniteAndTilted) {
  const double angle = 0.3;
  Plane plane;
  plane.normal = {-std::sin(angle), 0, std::cos(angle)};
  TestScene scene = scene_with(plane);
  const RayHit hit = scene.one({0, 0, 2}, {1, 0, 0});
  EXPECT_NEAR(hit.range_m, 2.0 / std::tan(angle), 1e-5);
  expect_normal(hit, plane.normal);
  EXPECT_NEAR(scene.one({5000, 100, 5000}, {0, 0, -1}, 1e5f).range_m,
              5000.0 - 5000.0 * std::tan(angle), 1e-3);
  EXPECT_EQ(scene.one({0, 0, 2}, {-1, 0, 0}, 1e6f).range_m, kInfinity);
}

TEST_P(Shapes, VisualPlaneHasItsSize) {
  TestScene scene(SceneKind::kVisual, options());
  scene.scene.add_scenery(0, {placed(model_of(Plane{{0, 0, 1}, {4, 2}}))});
  EXPECT_FLOAT_EQ(scene.one({1.99, 0.99, 1}, {0, 0, -1}).range_m, 1.0f);
  EXPECT_EQ(scene.one({2.01, 0, 1}, {0, 0, -1}).range_m, kInfinity);
  EXPECT_EQ(scene.one({0, 1.01, 1}, {0, 0, -1}).range_m, kInfinity);
}

TEST_P(Shapes, MeshBoxEqualsBox) {
  const Pose pose = Pose::from_xyz_rpy({4, 1, 0.5}, {0.4, -0.2, 1.1});
  TestScene mesh = scene_with(mesh_of({box_mesh("box", {1, 2, 3})}), pose);
  TestScene box = scene_with(Box{{1, 2, 3}}, pose);
  const RayPattern pattern = random_pattern(20000, 3);
  const auto a = mesh.cast({{3, 1, 2}, Eigen::Quaterniond::Identity()}, pattern);
  const auto b = box.cast({{3, 1, 2}, Eigen::Quaterniond::Identity()}, pattern);
  int hits = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isinf(b[i].range_m)) {
      EXPECT_EQ(a[i].range_m, kInfinity);
      continue;
    }
    ++hits;
    EXPECT_NEAR(a[i].range_m, b[i].range_m, 2e-6);
    EXPECT_LT((a[i].normal_W - b[i].normal_W).norm(), 1e-5f);
  }
  EXPECT_GT(hits, 1000);
}

TEST_P(Shapes, RoomOfFourWalls) {
  auto room = std::make_shared<Model>();
  room->name = "room";
  Link link;
  const double x = 4.0, y = 3.0;
  for (int side = 0; side < 4; ++side) {
    Collision wall;
    const double sign = side % 2 == 0 ? 1.0 : -1.0;
    if (side < 2) {
      wall.geometry = Box{{0.2, 2 * y, 2}};
      wall.X_LC.p = {sign * (x + 0.1), 0, 0};
    } else {
      wall.geometry = Box{{2 * x, 0.2, 2}};
      wall.X_LC.p = {0, sign * (y + 0.1), 0};
    }
    link.collisions.push_back(wall);
  }
  room->links.push_back(link);
  TestScene scene(SceneKind::kCollision, options());
  scene.scene.add_scenery(0, {placed(room)});
  const double yaw = 0.37;
  const Vector3d at(0.7, -0.4, 0.1);
  const RayPattern pattern = fan(1081, -0.75 * kPi, 0.75 * kPi);
  const auto hits = scene.cast(Pose::from_xyz_rpy(at, {0, 0, yaw}), pattern, 30.0f);
  for (int k = 0; k < 1081; ++k) {
    const double angle = yaw - 0.75 * kPi + 1.5 * kPi * k / 1080;
    const double to_x = (std::cos(angle) > 0 ? x - at.x() : -x - at.x()) / std::cos(angle);
    const double to_y = (std::sin(angle) > 0 ? y - at.y() : -y - at.y()) / std::sin(angle);
    EXPECT_NEAR(hits[static_cast<std::size_t>(k)].range_m, std::min(to_x, to_y), 2e-6) << k;
  }
}

TEST_P(Shapes, ScaleOfPlacementAndOfMesh) {
  const Pose at{{5, 0, 0}, Eigen::Quaterniond::Identity()};
  TestScene sphere = scene_with(Sphere{0.5}, at, 2.0);
  EXPECT_FLOAT_EQ(sphere.one({0, 0, 0}, {1, 0, 0}).range_m, 4.0f);
  Mesh mesh = mesh_of({box_mesh("box", {1, 1, 1})});
  mesh.scale = {2, -3, 4};
  TestScene scaled = scene_with(mesh, at, 0.5);
  EXPECT_FLOAT_EQ(scaled.one({0, 0.7, 0.9}, {1, 0, 0}).range_m, 4.5f);
  EXPECT_EQ(scaled.one({0, 0.76, 0}, {1, 0, 0}).range_m, kInfinity);
  EXPECT_EQ(scaled.one({0, 0, 1.01}, {1, 0, 0}).range_m, kInfinity);
}

TEST_P(Shapes, SubmeshAndCenter) {
  Mesh mesh =
      mesh_of({box_mesh("left", {1, 1, 1}, {0, 3, 0}), box_mesh("right", {1, 1, 1}, {0, -3, 0})});
  mesh.submesh = "left";
  const Pose at{{5, 0, 0}, Eigen::Quaterniond::Identity()};
  TestScene left = scene_with(mesh, at);
  EXPECT_FLOAT_EQ(left.one({0, 3, 0}, {1, 0, 0}).range_m, 4.5f);
  EXPECT_EQ(left.one({0, -3, 0}, {1, 0, 0}).range_m, kInfinity);
  mesh.center = true;
  TestScene centered = scene_with(mesh, at);
  EXPECT_FLOAT_EQ(centered.one({0, 0, 0}, {1, 0, 0}).range_m, 4.5f);
  EXPECT_EQ(centered.one({0, 3, 0}, {1, 0, 0}).range_m, kInfinity);
  mesh.submesh = "middle";
  TestScene wrong(SceneKind::kVisual);
  try {
    wrong.scene.add_scenery(0, {placed(model_of(mesh))});
    FAIL() << "a submesh that does not exist was accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no submesh 'middle'"), std::string::npos)
        << error.what();
  }
}

TEST_P(Shapes, BeyondTheMaximumIsInfinite) {
  TestScene scene = scene_with(Box{{1, 1, 1}}, {{5, 0, 0}, Eigen::Quaterniond::Identity()});
  EXPECT_EQ(scene.one({0, 0, 0}, {1, 0, 0}, 4.49f).range_m, kInfinity);
  EXPECT_EQ(scene.one({0, 0, 0}, {1, 0, 0}, 4.49f).entity, kNoEntity);
  EXPECT_FLOAT_EQ(scene.one({0, 0, 0}, {1, 0, 0}, 4.51f).range_m, 4.5f);
}

}  // namespace
}  // namespace ardee::test
