// SPDX-License-Identifier: MIT
// Tests of motion blur and rolling shutter against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pictures.h"

namespace ardee::test {
using namespace raycast;
using namespace render;
namespace {

constexpr double kFar_m = 2.0;
constexpr double kFocal_px = 200.0;
constexpr int kWidth_px = 400, kHeight_px = 64;
constexpr int kMiddle_px = kWidth_px / 2;

/// Returns a camera before a wall that glows to the left of the picture's middle, which begins at
/// column 200.
Camera before_edge(const Twist& twist_W) {
  Camera camera;
  camera.width = kWidth_px;
  camera.height = kHeight_px;
  camera.horizontal_fov_rad = kPi / 2;
  camera.motion.twist_W = twist_W;
  return camera;
}

Frame frame_of(const Camera& camera) {
  Material glowing;
  glowing.diffuse = glowing.ambient = Color(0, 0, 0, 1);
  glowing.emissive = Color(1, 1, 1, 1);
  TestStage stage;
  stage.placements = {placed(model_of(mesh_of({box_mesh("wall", {0.001f, 8, 8})}), {}, glowing),
                             {{kFar_m + 0.0005, 4, 0}, Eigen::Quaterniond::Identity()}, 1.0, 7)};
  MaterialLibrary materials((Log()));
  RayScene rays(SceneKind::kVisual, {}, Log());
  materials.add(stage.placements[0].model);
  rays.add_scenery(0, stage.placements);
  rays.prepare({camera.X_WC.p}, true);
  RenderOptions options;
  options.approximate = true;
  FrameParts parts;
  parts.light = parts.depth = parts.ids = true;
  return Renderer(rays.pictures(), materials, stage.scene, {}).render_frame(camera, parts, options);
}

/// Returns the number of bright columns of a row, which ends at the edge.
double edge_px(const Frame& frame, int row) {
  double sum = 0.0;
  for (int x = 0; x < kWidth_px; ++x)
    sum += static_cast<double>(frame.light[frame.index(x, row)][1]);
  return sum;
}

int edge_of_labels_px(const Frame& frame, int row) {
  const auto begin = frame.labels.begin() + static_cast<std::ptrdiff_t>(frame.index(0, row));
  return static_cast<int>(std::count(begin, begin + kWidth_px, 7));
}

TEST(MovingCamera, AnEdgeBecomesALinearRamp) {
  Camera camera = before_edge({{0, 0.8, 0}, {0, 0, 0}});
  camera.motion.exposure_time_s = 0.25;
  const double ramp_px = 0.8 * kFocal_px * 0.25 / kFar_m;
  ASSERT_DOUBLE_EQ(ramp_px, 20.0);
  const Frame frame = frame_of(camera);
  for (const int row : {0, 31, 63}) {
    for (int x = 0; x < kWidth_px; ++x) {
      const double dark = std::clamp((x + 0.5 - kMiddle_px) / ramp_px, 0.0, 1.0);
      ASSERT_NEAR(frame.light[frame.index(x, row)][1], 1.0 - dark, 0.51 / ramp_px) << x;
    }
    EXPECT_EQ(edge_of_labels_px(frame, row), kMiddle_px + 10);  // in the middle of the exposure
  }
}

TEST(MovingCamera, TheRampIsLongerThanTheNumberOfMoments) {
  Camera camera = before_edge({{0, 4.0, 0}, {0, 0, 0}});
  camera.motion.exposure_time_s = 0.4;
  const Frame frame = frame_of(camera);
  for (int x = kMiddle_px; x < kMiddle_px + 160; ++x) {
    ASSERT_NEAR(frame.light[frame.index(x, 8)][1], 1.0 - (x + 0.5 - kMiddle_px) / 160.0, 1.0 / 64);
  }
}

TEST(MovingCamera, AnEdgeLeansUnderARollingShutter) {
  for (const double speed : {0.5, -0.5}) {
    Camera camera = before_edge({{0, speed, 0}, {0, 0, 0}});
    camera.motion.readout_time_s = 0.6;
    const Frame frame = frame_of(camera);
    for (int row = 0; row < kHeight_px; ++row) {
      const double lean_px = speed * kFocal_px * 0.6 / kFar_m * row / kHeight_px;
      ASSERT_NEAR(edge_px(frame, row), kMiddle_px + lean_px, 1.3) << row;  // four rows at once
      ASSERT_EQ(edge_of_labels_px(frame, row), std::lround(edge_px(frame, row))) << row;
    }
  }
}

TEST(MovingCamera, ATurnMovesThePictureByItsTangent) {
  Camera camera = before_edge({{0, 0, 0}, {0, 0, 0.5}});
  camera.motion.readout_time_s = 0.4;
  camera.motion.exposure_time_s = 0.2;
  const Frame frame = frame_of(camera);
  for (int row = 0; row < kHeight_px; ++row) {
    const double middle_s = 0.1 + 0.4 * row / kHeight_px;
    const double expected_px = kMiddle_px + kFocal_px * std::tan(0.5 * middle_s);
    ASSERT_NEAR(edge_px(frame, row), expected_px, 1.5) << row;
  }
}

TEST(MovingCamera, DepthIsThatOfItsOwnTime) {
  Camera camera = before_edge({{1, 0, 0}, {0, 0, 0}});
  camera.motion.readout_time_s = 0.5;
  camera.motion.exposure_time_s = 0.2;
  const Frame frame = frame_of(camera);
  for (int row = 0; row < kHeight_px; ++row) {
    const double expected_m = kFar_m - 0.1 - 0.5 * row / kHeight_px;
    ASSERT_NEAR(frame.depth_m[frame.index(50, row)], expected_m, 1.5 * 0.5 / kHeight_px + 1e-6);
  }
}

TEST(MovingCamera, AtRestItsPictureIsThatOfAnInstant) {
  Camera camera = before_edge({});
  const Frame instant = frame_of(camera);
  camera.motion.exposure_time_s = 0.1;
  camera.motion.readout_time_s = 0.1;
  EXPECT_EQ(frame_of(camera).light, instant.light);
}

}  // namespace
}  // namespace ardee::test
