// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "ardee_sim/render/camera.h"

namespace ardee {
using namespace render;
namespace {

Lens barrel() {
  Lens lens = Lens::pinhole(640, 480, 1.2);
  lens.D = {-0.28, 0.07, 0.001, -0.0005, 0.002};
  return lens;
}

TEST(Lens, APinholeHasItsMiddleBetweenTheMiddlePixels) {
  const Lens lens = Lens::pinhole(640, 480, M_PI / 2);
  EXPECT_DOUBLE_EQ(lens.cx_px, 319.5);
  EXPECT_DOUBLE_EQ(lens.cy_px, 239.5);
  EXPECT_NEAR(lens.fx_px, 320.0, 1e-9);
  EXPECT_NEAR(lens.to_pixel({1.0, 0.0}).x(), 639.5, 1e-9);  // the right edge, 45 degrees off axis
}

TEST(Lens, StraighteningUndoesBending) {
  const Lens lens = barrel();
  for (double u = 0; u < 640; u += 13) {
    for (double v = 0; v < 480; v += 11) {
      const auto plane = lens.to_plane({u, v});
      ASSERT_TRUE(plane) << u << " " << v;
      ASSERT_NEAR((lens.to_pixel(*plane) - Eigen::Vector2d(u, v)).norm(), 0.0, 1e-8);
    }
  }
}

TEST(Lens, SkewShiftsRows) {
  Lens lens = Lens::pinhole(640, 480, M_PI / 2);
  lens.skew_px = 12.0;
  const Eigen::Vector2d pixel = lens.to_pixel({0.25, 0.5});
  EXPECT_NEAR(pixel.x(), 320.0 * 0.25 + 12.0 * 0.5 + 319.5, 1e-9);
  EXPECT_NEAR(pixel.y(), 320.0 * 0.5 + 239.5, 1e-9);
  EXPECT_NEAR((*lens.to_plane(pixel) - Eigen::Vector2d(0.25, 0.5)).norm(), 0.0, 1e-12);
  const UndistortionMap table(lens, 640, 480);  // its pixels count from their corners
  EXPECT_NEAR((table.plane(pixel.x() + 0.5, pixel.y() + 0.5) - Eigen::Vector2d(0.25, 0.5)).norm(),
              0.0, 1e-12);
}

TEST(Lens, BendsAsThePlumbBobModelSays) {
  Lens lens;
  lens.D = {0.1, 0.01, 0.002, 0.003, 0.001};
  const double x = 0.3, y = -0.2, r2 = 0.13;
  const double radial = 1 + 0.1 * r2 + 0.01 * r2 * r2 + 0.001 * r2 * r2 * r2;
  const Eigen::Vector2d bent = lens.distort({x, y});
  EXPECT_NEAR(bent.x(), x * radial + 2 * 0.002 * x * y + 0.003 * (r2 + 2 * x * x), 1e-15);
  EXPECT_NEAR(bent.y(), y * radial + 0.002 * (r2 + 2 * y * y) + 2 * 0.003 * x * y, 1e-15);
}

TEST(Lens, BeyondTheFoldOfABarrelThereIsNoLight) {
  Lens lens;
  lens.D[0] = -0.5;  // x (1 - 0.5 x^2) has its greatest value of 0.544 at x = 0.816
  EXPECT_TRUE(lens.undistort({0.54, 0.0}));
  EXPECT_FALSE(lens.undistort({0.56, 0.0}));
}

TEST(Camera, ALensTableGivesTheWayThroughEachPixel) {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  const Lens lens = barrel();
  camera.lens = std::make_shared<UndistortionMap>(lens, camera.width, camera.height);
  for (int row = 0; row < 480; row += 7) {
    for (int column = 0; column < 640; column += 5) {
      const Eigen::Vector3d point_W = 3.0 * camera.direction_W(column + 0.5, row + 0.5);
      const auto seen = camera.project(point_W);
      ASSERT_TRUE(seen);
      ASSERT_NEAR(seen->x(), column + 0.5, 1e-3);
      ASSERT_NEAR(seen->y(), row + 0.5, 1e-3);
    }
  }
}

}  // namespace
}  // namespace ardee
