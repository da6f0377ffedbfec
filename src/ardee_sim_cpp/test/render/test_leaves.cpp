// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "pictures.h"

namespace ardee::test {
using namespace render;
namespace {

/// Returns leaves turned in all directions about the vertical, each a strip that bends over.
Mesh plant() {
  std::vector<SubMesh> parts;
  for (int leaf = 0; leaf < 8; ++leaf) {
    const double yaw = 2.0 * kPi * leaf / 8;
    const Eigen::Vector3d out(std::cos(yaw), std::sin(yaw), 0), side(-out.y(), out.x(), 0);
    SubMesh part;
    for (int k = 0; k <= 6; ++k) {
      const double s = k / 6.0;
      const Eigen::Vector3d middle = s * out + Eigen::Vector3d(0, 0, 1.2 * s - s * s);
      for (const double edge : {-0.1, 0.1}) {
        part.vertices.push_back((middle + edge * side).cast<float>());
      }
    }
    for (std::uint32_t k = 0; k < 12; k += 2) {
      part.triangles.push_back({k, k + 1, k + 3});
      part.triangles.push_back({k, k + 3, k + 2});
    }
    parts.push_back(part);
  }
  return mesh_of(parts);
}

Camera beside() {
  Camera camera;
  camera.X_WC = look_at({3, 0.4, 0.3}, {0, 0, 0.3});
  camera.width = 240;
  camera.height = 160;
  return camera;
}

int leaf_pixels(const Material& material, const Camera& camera, const Geometry& geometry) {
  TestStage stage;
  stage.scene.ambient = Color::Ones();
  stage.placements = {placed(model_of(geometry, {}, material))};
  return lit_pixels(stage.picture(camera));
}

/// Thesis Figure 4.2: without the material for both sides, leaves are missing.
TEST(Leaves, BothSidesAreSeenOnlyWithTheMaterialForThem) {
  const int both = leaf_pixels(two_sided(), beside(), plant());
  const int one = leaf_pixels(Material{}, beside(), plant());
  EXPECT_GT(one, 500);
  EXPECT_GT(both, one * 11 / 10);
}

TEST(Leaves, SheetIsSeenFromBothSidesOrFromOne) {
  SubMesh part;
  part.vertices = {{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}};
  part.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Geometry sheet = mesh_of({part});
  Camera front;
  front.X_WC = look_at({4, 0, 0}, {0, 0, 0});
  front.width = front.height = 64;
  Camera back = front;
  back.X_WC = look_at({-4, 0, 0}, {0, 0, 0});
  const int whole = leaf_pixels(two_sided(), front, sheet);
  EXPECT_GT(whole, 600);
  EXPECT_EQ(leaf_pixels(two_sided(), back, sheet), whole);
  EXPECT_EQ(leaf_pixels(Material{}, front, sheet), whole);
  EXPECT_EQ(leaf_pixels(Material{}, back, sheet), 0);
}

TEST(Leaves, LightComesThroughASheetButNotIntoABox) {
  Material material = matt(0.5f);
  material.two_sided = true;
  Camera camera;
  camera.X_WC = look_at({4, 0, 0}, {0, 0, 0});
  camera.width = camera.height = 33;
  const auto middle = [&](const Geometry& geometry) {
    TestStage stage;
    stage.placements = {placed(model_of(geometry, {}, material))};
    stage.lights = {sun({1, 0, 0})};  // from behind, as the camera sees it
    const Image image = stage.picture(camera);
    return int{image.samples8[image.index(16, 16)]};
  };
  SubMesh part;
  part.vertices = {{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}};
  part.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_GT(middle(mesh_of({part})), 20);
  EXPECT_LT(middle(mesh_of({part})), 100);
  EXPECT_EQ(middle(mesh_of({box_mesh("box", {1, 1, 1})})), 0);
}

}  // namespace
}  // namespace ardee::test
