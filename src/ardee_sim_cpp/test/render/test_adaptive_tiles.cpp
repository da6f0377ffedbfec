// SPDX-License-Identifier: MIT
// Tests of quick pictures against thorough ones.
#include <gtest/gtest.h>

#include "pictures.h"

namespace ardee::test {
using namespace raycast;
using namespace render;
namespace {

/// Returns boxes of triangles, which are in the triangle scene, on a floor, which is not; and a
/// stick of one or two pixels.
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

  /// Returns the number of pixels that differ by more than `most`.
  int different(float most) const {
    int count = 0;
    for (std::size_t k = 0; k < quick.light.size(); ++k) {
      const float most_here = (quick.light[k] - thorough.light[k]).cwiseAbs().maxCoeff();
      count += most_here <= most ? 0 : 1;
    }
    return count;
  }
};

Pair render_frame(const TestStage& stage, const Camera& camera, bool shadows) {
  MaterialLibrary materials((Log()));
  RayScene rays(SceneKind::kVisual, {}, Log());
  for (const Placement& placement : stage.placements) materials.add(placement.model);
  rays.add_scenery(0, stage.placements);
  rays.prepare({camera.X_WC.p}, true);
  const Renderer renderer(rays.pictures(), materials, stage.scene, stage.lights);
  RenderOptions options;
  options.shadows = shadows;
  FrameParts light;
  light.light = true;
  Pair pair;
  pair.thorough = renderer.render_frame(camera, light, options);
  options.approximate = true;
  pair.quick = renderer.render_frame(camera, light, options);
  return pair;
}

TEST(QuickPictures, AreThoroughOnesWhereLightIsEven) {
  // Each face has one light: only the surface of a pixel at an edge may differ.
  for (const auto& [width, height] : std::vector<std::pair<int, int>>{
           {1, 1}, {3, 2}, {4, 4}, {10, 11}, {31, 33}, {64, 48}, {101, 67}, {320, 240}}) {
    const Pair pair = render_frame(boxes(), ahead(width, height), false);
    EXPECT_LE(pair.different(1e-3f), width * height / 5000) << width << " x " << height;
  }
}

TEST(QuickPictures, HaveShadowsAlongTheSameEdges) {
  const Pair pair = render_frame(boxes(), ahead(320, 240), true);
  const Pair unshadowed = render_frame(boxes(), ahead(320, 240), false);
  Pair shadows{pair.thorough, unshadowed.thorough};
  EXPECT_GT(shadows.different(0.05f), 10000);
  EXPECT_LE(pair.different(1e-3f), 100);
}

TEST(QuickPictures, SeeThroughALensAsThoroughOnesDo) {
  Camera camera = ahead(160, 120);
  Lens lens = Lens::pinhole(160, 120, 1.6);
  lens.D = {-0.35, 0.0, 0.001, -0.001, 0.0};  // a barrel, dark in the corners
  camera.lens = std::make_shared<UndistortionMap>(lens, 160, 120);
  TestStage stage = boxes();
  stage.scene.background = Color(0.2f, 0.3f, 0.4f, 1);
  const Pair pair = render_frame(stage, camera, true);
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

/// Quick pictures of a stage, one after the other, by one renderer.
class Studio {
 public:
  explicit Studio(const TestStage& stage)
      : materials_((Log())), rays_(SceneKind::kVisual, {}, Log()) {
    for (const Placement& placement : stage.placements) materials_.add(placement.model);
    rays_.add_scenery(0, stage.placements);
    renderer_.emplace(rays_.pictures(), materials_, stage.scene, stage.lights);
  }

  void replace_scenery(const TestStage& stage) {
    rays_.remove_scenery(0);
    rays_.add_scenery(0, stage.placements);
  }
  void add_model(const std::shared_ptr<const Model>& model) {
    materials_.add(model);
    rays_.add_model(kMoving, model);
  }
  void move(const Eigen::Vector3d& to_W) {
    rays_.set_link_poses(kMoving, {{to_W, Eigen::Quaterniond::Identity()}});
  }
  Frame render_frame(const Camera& camera, int threads = 0, bool approximate = true) {
    rays_.prepare({camera.X_WC.p}, true);
    FrameParts light;
    light.light = true;
    RenderOptions options;
    options.approximate = approximate;
    options.threads = threads;
    return renderer_->render_frame(camera, light, options);
  }

 private:
  static constexpr std::uint32_t kMoving = 5000;
  MaterialLibrary materials_;
  RayScene rays_;
  std::optional<Renderer> renderer_;
};

Camera moved(Camera camera, double x_m) {
  camera.X_WC.p.x() += x_m;
  return camera;
}

TEST(QuickPictures, AreTheSameWithAnyNumberOfThreads) {
  Studio one(boxes());
  const Frame expected = one.render_frame(ahead(150, 110), 1);
  for (const int threads : {2, 5}) {
    Studio other(boxes());
    EXPECT_EQ(other.render_frame(ahead(150, 110), threads).light, expected.light) << threads;
  }
}

TEST(QuickPictures, AreTheSameWhateverCameBefore) {
  // Values kept from earlier pictures equal those that would be computed now.
  Studio fresh(boxes());
  const Frame expected = fresh.render_frame(ahead(150, 110), 1);
  EXPECT_EQ(fresh.render_frame(ahead(150, 110), 1).light, expected.light);
  Studio driving(boxes());
  for (const double x_m : {-0.5, -0.4, -0.1, 0.05, -0.01}) {
    driving.render_frame(moved(ahead(150, 110), x_m), 5);
  }
  EXPECT_EQ(driving.render_frame(ahead(150, 110), 5).light, expected.light);
}

TEST(QuickPictures, HaveTheShadowsOfModelsWhereTheyAreNow) {
  TestStage stage = boxes();
  stage.placements.push_back(
      placed(model_of(mesh_of({box_mesh("ground", {12, 12, 0.02f})}), {}, matt(0.5f)),
             Pose::from_xyz_rpy({3, 0, 0.01}, {0, 0, 0})));
  const auto model = model_of(mesh_of({box_mesh("box", {0.4f, 0.4f, 0.4f})}), {}, matt(0.7f));
  Studio driving(stage);
  driving.add_model(model);
  for (const double y_m : {-0.6, 0.0, 0.7}) {
    driving.move({1.8, y_m, 0.6});
    const Frame now = driving.render_frame(ahead(320, 240));
    Studio fresh(stage);
    fresh.add_model(model);
    fresh.move({1.8, y_m, 0.6});
    EXPECT_EQ(now.light, fresh.render_frame(ahead(320, 240)).light) << y_m;
    const Pair pair{now, fresh.render_frame(ahead(320, 240), 0, false)};
    EXPECT_LE(pair.different(0.05f), 800) << y_m;
    fresh.move({1.8, y_m, 50.0});
    const Pair moved_away{now, fresh.render_frame(ahead(320, 240))};
    EXPECT_GT(moved_away.different(0.05f), 1000) << y_m;
  }
}

TEST(QuickPictures, SeeEachSideOfALeafInItsOwnLight) {
  SubMesh leaf;
  leaf.name = "leaf";
  leaf.vertices = {{2, -1, 0}, {2, 1, 0}, {2, 1, 2}, {2, -1, 2}};
  leaf.triangles = {{0, 1, 2}, {0, 2, 3}};
  Material green = matt(0.5f);
  green.two_sided = true;
  TestStage stage;
  stage.placements = {placed(model_of(mesh_of({leaf}), {}, green))};
  stage.lights = {sun({0.8, 0.1, -0.6})};
  Camera behind = ahead(320, 240);
  behind.X_WC = Pose::from_xyz_rpy({4, 0, 1}, {0, 0.15, kPi});
  Studio studio(stage);
  const Frame lit = studio.render_frame(ahead(320, 240));
  const Frame dim = studio.render_frame(behind);
  EXPECT_EQ(studio.render_frame(ahead(320, 240)).light, lit.light);
  EXPECT_EQ(Studio(stage).render_frame(behind).light, dim.light);
  const std::size_t middle = lit.index(160, 120);
  EXPECT_NEAR(lit.light[middle].x(), 0.5f * 0.8f / std::sqrt(1.01f), 1e-3f);
  EXPECT_NEAR(dim.light[middle].x(), 0.4f * lit.light[middle].x(), 1e-3f);
}

TEST(QuickPictures, ForgetWhatHasGone) {
  const TestStage stage = boxes();
  TestStage other = stage;
  other.placements.erase(other.placements.begin() + 1);
  Studio studio(stage);
  studio.render_frame(ahead(150, 110));
  studio.replace_scenery(other);
  Studio fresh(other);
  EXPECT_EQ(studio.render_frame(ahead(150, 110)).light, fresh.render_frame(ahead(150, 110)).light);
}

TEST(QuickPictures, SeeWhatIsBehindGlass) {
  TestStage stage = boxes();
  Material glass = matt(0.3f);
  glass.diffuse[3] = 0.4f;
  glass.two_sided = true;
  const auto pane = model_of(mesh_of({box_mesh("pane", {0.01f, 1.5f, 1.0f})}), {}, glass);
  stage.placements.push_back(placed(pane, Pose::from_xyz_rpy({1.5, 0, 0.8}, {0, 0, 0})));
  Studio studio(stage);
  const Frame first = studio.render_frame(ahead(160, 120));
  EXPECT_EQ(studio.render_frame(ahead(160, 120)).light, first.light);
  const Pair pair{first, studio.render_frame(ahead(160, 120), 0, false)};
  EXPECT_LE(pair.different(0.02f), 300);
}

}  // namespace
}  // namespace ardee::test
