// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "scenes.h"

namespace ardee::test {
using namespace raycast;
namespace {

std::shared_ptr<HeightGrid> rough_grid(int columns, int rows, double size_x_m, double size_y_m) {
  auto grid = std::make_shared<HeightGrid>();
  grid->columns = columns;
  grid->rows = rows;
  grid->size_m = {size_x_m, size_y_m};
  Rng rng(mix_bits(11));
  for (int k = 0; k < columns * rows; ++k) {
    grid->heights_m.push_back(static_cast<float>(0.3 * rng.uniform()));
  }
  return grid;
}

/// Returns the height on the cell's two triangles, cut from (column, row) to (column + 1, row + 1).
double height_at(const HeightGrid& grid, double x, double y) {
  const double u = (x / grid.size_m.x() + 0.5) * (grid.columns - 1);
  const double v = (y / grid.size_m.y() + 0.5) * (grid.rows - 1);
  const int c = std::min(static_cast<int>(u), grid.columns - 2);
  const int r = std::min(static_cast<int>(v), grid.rows - 2);
  const double a = u - c, b = v - r;
  const double h00 = grid.at(c, r), h10 = grid.at(c + 1, r);
  const double h01 = grid.at(c, r + 1), h11 = grid.at(c + 1, r + 1);
  return a >= b ? h00 + a * (h10 - h00) + b * (h11 - h10) : h00 + a * (h11 - h01) + b * (h01 - h00);
}

TEST(Terrain, HeightsFromAboveAreThoseOfTheTriangles) {
  const auto grid = rough_grid(33, 21, 16.0, 10.0);
  Heightmap map;
  map.grid = grid;
  map.position_m = {1.0, -2.0, 0.5};
  for (const bool flatten : {true, false}) {
    RayOptions options;
    options.local_scenes = flatten;
    TestScene scene(SceneKind::kVisual, options);
    scene.scene.add_scenery(4, {placed(model_of(map))});
    Rng rng(mix_bits(5));
    for (int k = 0; k < 3000; ++k) {
      const double x = 16.0 * (rng.uniform() - 0.5), y = 10.0 * (rng.uniform() - 0.5);
      const RayHit hit = scene.one({x + 1.0, y - 2.0, 3.5}, {0, 0, -1});
      EXPECT_NEAR(hit.range_m, 3.0 - height_at(*grid, x, y), 1e-6);
      EXPECT_GT(hit.normal_W.z(), 0.5f);
    }
  }
}

TEST(Terrain, NoRaySlipsThrough) {
  // Rays come from below, on vertices, along edges and anywhere: the collision scene's terrain is
  // hit from both sides.
  const auto grid = rough_grid(65, 65, 32.0, 32.0);
  Heightmap map;
  map.grid = grid;
  RayOptions options;
  options.local_scene_radius_m = 3.0;
  TestScene scene(SceneKind::kCollision, options);
  scene.scene.add_scenery(
      0, {placed(model_of(map), Pose::from_xyz_rpy({100.3, -77.7, 1.1}, {0.02, 0.05, 0.7}))});
  const Pose X_WM = Pose::from_xyz_rpy({100.3, -77.7, 1.1}, {0.02, 0.05, 0.7});
  const Eigen::Vector3d eye_M(0.1, 0.2, 1.7);
  RayPattern pattern;
  for (int row = 8; row < 56; ++row) {
    for (int column = 8; column < 56; ++column) {
      const Eigen::Vector3d v(0.5 * column - 16.0, 0.5 * row - 16.0, grid->at(column, row));
      for (const Eigen::Vector3d& target : {v, Eigen::Vector3d(v + Eigen::Vector3d(0.25, 0, 0)),
                                            Eigen::Vector3d(v + Eigen::Vector3d(0.1, 0.1, 0))}) {
        pattern.directions_S.push_back((target - eye_M).normalized().cast<float>());
      }
    }
  }
  const RayPattern more = random_pattern(200000, 9);
  for (const Eigen::Vector3f& direction : more.directions_S) {
    if (direction.z() < -0.2f) pattern.directions_S.push_back(direction);
  }
  const auto hits = scene.cast({X_WM * eye_M, X_WM.q}, pattern, 100.0f);
  for (const RayHit& hit : hits) EXPECT_TRUE(std::isfinite(hit.range_m));
}

TEST(Terrain, VisualTerrainIsOneSided) {
  Heightmap map;
  map.grid = rough_grid(9, 9, 8.0, 8.0);
  TestScene scene(SceneKind::kVisual);
  scene.scene.add_scenery(0, {placed(model_of(map))});
  EXPECT_TRUE(std::isfinite(scene.one({0.3, 0.2, 2}, {0, 0, -1}).range_m));
  EXPECT_EQ(scene.one({0.3, 0.2, -2}, {0, 0, 1}).range_m, kInfinity);
}

TEST(Terrain, BrokenGridIsRefused) {
  Heightmap map;
  map.grid = rough_grid(1, 9, 8.0, 8.0);
  TestScene scene(SceneKind::kVisual);
  EXPECT_THROW(scene.scene.add_scenery(0, {placed(model_of(map))}), Error);
  auto grid = rough_grid(9, 9, 8.0, 8.0);
  grid->heights_m[13] = std::numeric_limits<float>::quiet_NaN();
  map.grid = grid;
  EXPECT_THROW(scene.scene.add_scenery(0, {placed(model_of(map))}), Error);
  grid->heights_m.resize(12);
  EXPECT_THROW(scene.scene.add_scenery(0, {placed(model_of(map))}), Error);
}

}  // namespace
}  // namespace ardee::test
