// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "ardee_sim/raycast/local_scene.h"
#include "ardee_sim/raycast/scenery_store.h"
#include "scenes.h"

namespace ardee::test {
using namespace raycast;
namespace {

constexpr std::size_t kPlenty = 1u << 30;
constexpr double kBox_m = 0.2;
constexpr std::size_t kTriangles = 12;  // per box

/// Returns a budget for `count` boxes in a triangle scene, one byte short of the next.
std::size_t bytes_of(std::size_t count) {
  return (count + 1) * kTriangles * LocalScene::kBytesPerTriangle - 1;
}

/// Boxes a metre apart, one at each integer place up to 10 m each way: (2 n + 1)^2 of them touch
/// the square that reaches n metres but not the next ones.
class LocalSceneTest : public testing::Test {
 protected:
  LocalSceneTest() {
    const auto box = model_of(mesh_of({box_mesh("box", Eigen::Vector3f::Constant(kBox_m))}));
    std::vector<Placement> placements;
    for (int x = -10; x <= 10; ++x) {
      for (int y = -10; y <= 10; ++y) {
        placements.push_back(
            placed(box, {Eigen::Vector3d(x, y, 0), Eigen::Quaterniond::Identity()}));
      }
    }
    store_.add(0, placements);
  }

  LocalScene local(const LocalSceneBudget& budget) {
    store_.commit();
    return LocalScene(store_.fixed(), {}, {{0, 0}, 8.5, budget});
  }

  Log log_;
  SceneryStore store_{SceneKind::kVisual, log_};
};

TEST_F(LocalSceneTest, ReachesAsFarAsAskedWhereAllFits) {
  const LocalScene made = local({kPlenty, kPlenty});
  EXPECT_EQ(made.half_size_m(), 8.5);
  EXPECT_EQ(made.triangles(), 17 * 17 * kTriangles);
  EXPECT_NE(made.triangle_scene(), nullptr);
  EXPECT_FALSE(made.holds_all());
}

TEST_F(LocalSceneTest, ReachesAsFarAsTheEntriesFit) {
  // 7 x 7 fit, 9 x 9 do not: the square ends before the boxes about 4 m.
  const LocalScene made = local({60 * LocalScene::kBytesPerEntry});
  EXPECT_NEAR(made.half_size_m(), 4.0 - kBox_m / 2, 0.05);
  EXPECT_EQ(made.triangles(), 49 * kTriangles);
  EXPECT_FALSE(made.is_for_pictures());
  EXPECT_EQ(made.triangle_scene(), nullptr);
}

TEST_F(LocalSceneTest, ReachesAsFarAsTheDraftFits) {
  const LocalScene exact = local({kPlenty, bytes_of(49)});
  EXPECT_NEAR(exact.half_size_m(), 4.0 - kBox_m / 2, 0.05);
  EXPECT_NE(exact.triangle_scene(), nullptr);
  const LocalScene one_less = local({kPlenty, bytes_of(48)});
  EXPECT_NEAR(one_less.half_size_m(), 3.0 - kBox_m / 2, 0.05);
  EXPECT_EQ(one_less.triangles(), 25 * kTriangles);
  EXPECT_NE(one_less.triangle_scene(), nullptr);
}

class TrianglesTooMany : public LocalSceneTest, public testing::WithParamInterface<float> {};

INSTANTIATE_TEST_SUITE_P(LocalScene, TrianglesTooMany, testing::Values(40.0f, 0.5f));

TEST_P(TrianglesTooMany, DoesNotShrinkTheSquare) {
  // One mesh at the middle has 50 boxes; a wide mesh is in the triangle scene as a whole.
  std::vector<SubMesh> parts;
  for (int k = 0; k < 50; ++k) {
    const float x = 0.01f * static_cast<float>(k);
    parts.push_back(box_mesh("part", {0.005f, GetParam(), 0.1f}, {x, 0, -3}));
  }
  store_.add(1000, {placed(model_of(mesh_of(parts)))});
  const LocalScene made = local({kPlenty, bytes_of(49)});
  EXPECT_EQ(made.half_size_m(), 8.5);
  EXPECT_TRUE(made.is_for_pictures());
  EXPECT_EQ(made.triangle_scene(), nullptr);
}

TEST_F(LocalSceneTest, CountsTheCellsOfAWideGroundByPatches) {
  // Patches of 0.8 m, 128 triangles each: 10 x 10 of them touch a square that reaches 4 m, and
  // 9 x 9 boxes.
  auto grid = std::make_shared<HeightGrid>();
  grid->columns = grid->rows = 401;
  grid->size_m = {40.0, 40.0};
  grid->heights_m.assign(401u * 401u, -1.0f);
  Heightmap ground;
  ground.grid = grid;
  store_.add(1000, {placed(model_of(ground))});
  const std::size_t triangles = 100 * 128 + 81 * kTriangles;
  const LocalScene made = local({kPlenty, triangles * LocalScene::kBytesPerTriangle});
  EXPECT_NEAR(made.half_size_m(), 4.0, 0.05);
  EXPECT_NE(made.triangle_scene(), nullptr);
  EXPECT_FALSE(made.has_rest());
}

}  // namespace
}  // namespace ardee::test
