// SPDX-License-Identifier: MIT
// Quick pictures against thorough ones.
#include <gtest/gtest.h>

#include "pictures.h"

namespace ardee::test {
namespace {

/// Boxes of triangles, which are in the draft, on a floor, which is not; a stick of a pixel or two.
TestStage boxes() {
  TestStage stage;
  Plane floor;
  floor.size_m = {20, 20};
  stage.placements = {placed(model_of(floor, {}, matt(0.6f)))};
  const auto add = [&](const Eigen::Vector3f& size_m, const Pose& pose, float share) {
    stage.placements.push_back(
        placed(model_of(mesh_of({box_mesh("box", size_m)}), {}, matt(share)), pose));
  };
  add({1.0f, 1.0f, 1.0f}, Pose::from_xyz_rpy({3, 0.4, 0.5}, {0, 0, 0.3}), 0.9f);
  add({0.6f, 0.4f, 1.2f}, Pose::from_xyz_rpy({2.5, -0.7, 0.6}, {0, 0, 1.0}), 0.4f);
  add({0.008f, 0.008f, 2.0f}, Pose::from_xyz_rpy({2.2, 0.0, 1.0}, {0.1, 0, 0}), 0.8f);
  stage.lights = {sun({-0.6, 0.5, -0.7})};
  return stage;
}

Camera ahead(int width, int height) {
  Camera camera;
  camera.X_WC = Pose::from_xyz_rpy({0, 0, 1}, {0, 0.15, 0});
  camera.width = width;
  camera.height = height;
  return camera;
}

struct Pair {
  Frame quick;
  Frame thorough;

  /// How many pixels differ by more than `most`.
  int different(float most) const {
    int count = 0;
    for (std::size_t k = 0; k < quick.light.size(); ++k) {
      const float most_here = (quick.light[k] - thorough.light[k]).cwiseAbs().maxCoeff();
      count += most_here <= most ? 0 : 1;
    }
    return count;
  }
};

Pair shoot(const TestStage& stage, const Camera& camera, bool shadows) {
  Looks looks((Log()));
  RayScene rays(SceneKind::kVisual, {}, Log());
  for (const Placement& placement : stage.placements) looks.add(placement.model);
  rays.add_scenery(0, stage.placements);
  rays.prepare({camera.X_WC.p}, true);
  const Renderer renderer(rays, looks, stage.scene, stage.lights);
  RenderOptions options;
  options.shadows = shadows;
  FrameParts light;
  light.light = true;
  Pair pair;
  pair.thorough = renderer.shoot(camera, light, options);
  options.quickly = true;
  pair.quick = renderer.shoot(camera, light, options);
  return pair;
}

TEST(QuickPictures, AreThoroughOnesWhereLightIsEven) {
  // Each face has one light: only whose surface a pixel at an edge is may be seen otherwise.
  for (const auto& [width, height] : std::vector<std::pair<int, int>>{
           {1, 1}, {3, 2}, {4, 4}, {10, 11}, {31, 33}, {64, 48}, {101, 67}, {320, 240}}) {
    const Pair pair = shoot(boxes(), ahead(width, height), false);
    EXPECT_LE(pair.different(1e-3f), width * height / 5000) << width << " x " << height;
  }
}

TEST(QuickPictures, HaveShadowsAlongTheSameEdges) {
  const Pair pair = shoot(boxes(), ahead(320, 240), true);
  const Pair unshadowed = shoot(boxes(), ahead(320, 240), false);
  Pair shadows{pair.thorough, unshadowed.thorough};
  EXPECT_GT(shadows.different(0.05f), 10000);
  EXPECT_LE(pair.different(1e-3f), 100);
}

TEST(QuickPictures, SeeThroughALensAsThoroughOnesDo) {
  Camera camera = ahead(160, 120);
  Lens lens = Lens::pinhole(160, 120, 1.6);
  lens.D = {-0.35, 0.0, 0.001, -0.001, 0.0};  // a barrel, dark in the corners
  camera.lens = std::make_shared<LensTable>(lens, 160, 120);
  TestStage stage = boxes();
  stage.scene.background = Color(0.2f, 0.3f, 0.4f, 1);
  const Pair pair = shoot(stage, camera, true);
  int dark = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      if (camera.direction_C(x + 0.5, y + 0.5).allFinite()) continue;
      ++dark;
      EXPECT_TRUE(pair.quick.light[pair.quick.index(x, y)].isZero(0.0f)) << x << ", " << y;
    }
  }
  EXPECT_GT(dark, 100);
  EXPECT_LE(pair.different(1e-3f), 50);
}

TEST(QuickPictures, AreTheSameWithAnyNumberOfThreadsAndWhateverCameBefore) {
  const TestStage stage = boxes();
  Looks looks((Log()));
  RayScene rays(SceneKind::kVisual, {}, Log());
  for (const Placement& placement : stage.placements) looks.add(placement.model);
  rays.add_scenery(0, stage.placements);
  rays.prepare({ahead(1, 1).X_WC.p}, true);
  const Renderer renderer(rays, looks, stage.scene, stage.lights);
  FrameParts light;
  light.light = true;
  RenderOptions options;
  options.quickly = true;
  std::vector<Frame> frames;
  for (const int threads : {1, 2, 5}) {
    options.threads = threads;
    frames.push_back(renderer.shoot(ahead(150, 110), light, options));
  }
  for (std::size_t k = 1; k < frames.size(); ++k) {
    EXPECT_EQ(frames[0].light, frames[k].light);
  }
}

}  // namespace
}  // namespace ardee::test
