// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "pictures.h"

namespace ardee::test {
using namespace render;
namespace {

TEST(Camera, DirectionsAndProjectionAreInverse) {
  Camera camera;
  camera.X_WC = Pose::from_xyz_rpy({1, -2, 3}, {0.2, 0.4, -1.3});
  for (const Eigen::Vector2d& pixel :
       {Eigen::Vector2d(0, 0), Eigen::Vector2d(640, 360), Eigen::Vector2d(1279.5, 3.25)}) {
    const Eigen::Vector3d point = camera.X_WC.p + 7.0 * camera.direction_W(pixel.x(), pixel.y());
    const auto back = camera.project(point);
    ASSERT_TRUE(back.has_value());
    EXPECT_NEAR((*back - pixel).norm(), 0.0, 1e-9);
  }
  EXPECT_FALSE(camera.project(camera.X_WC.p - camera.direction_W(640, 360)).has_value());
}

TEST(Camera, FieldOfViewSpansTheWidth) {
  Camera camera;
  camera.horizontal_fov_rad = 0.5 * kPi;
  EXPECT_NEAR((*camera.project({1, 1, 0}) - Eigen::Vector2d(0, 360)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((*camera.project({1, -1, 0}) - Eigen::Vector2d(1280, 360)).norm(), 0.0, 1e-9);
}

TEST(Camera, LooksAtItsTargetUpright) {
  Camera camera;
  camera.X_WC = look_at({3, 4, 5}, {-1, 2, 0.5});
  EXPECT_NEAR((*camera.project({-1, 2, 0.5}) - Eigen::Vector2d(640, 360)).norm(), 0.0, 1e-9);
  const Eigen::Vector2d above = *camera.project({-1, 2, 0.7});
  EXPECT_NEAR(above.x(), 640.0, 1e-9);
  EXPECT_LT(above.y(), 360.0);
  EXPECT_THROW(look_at({1, 1, 1}, {1, 1, 1}), Error);
}

}  // namespace
}  // namespace ardee::test
