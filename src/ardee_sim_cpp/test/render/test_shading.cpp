// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "ardee_sim/render/lights.h"
#include "ardee_sim/render/tone.h"
#include "pictures.h"

namespace ardee::test {
using namespace render;
namespace {

Plane floor_of(double side_m) {
  Plane plane;
  plane.size_m = {side_m, side_m};
  return plane;
}

TEST(Shading, PlaneFollowsLambert) {
  for (const double slant_rad : {0.0, 0.5, 1.2}) {
    TestStage stage;
    stage.placements = {placed(model_of(floor_of(10), {}, matt(0.6f)))};
    stage.lights = {sun({std::sin(slant_rad), 0, -std::cos(slant_rad)})};
    stage.lights[0].diffuse = Color(1, 0.5f, 0.25f, 1);
    const Image image = stage.picture(from_above(3));
    const std::uint8_t* middle = &image.samples8[image.index(50, 50)];
    const double expected = 255.0 * 0.6 * std::cos(slant_rad);
    EXPECT_NEAR(middle[0], expected, 0.51);
    EXPECT_NEAR(middle[1], 0.5 * expected, 0.51);
    EXPECT_NEAR(middle[2], 0.25 * expected, 0.51);
  }
}

TEST(Shading, AmbientAndEmissiveNeedNoLamp) {
  TestStage stage;
  Material material = matt(0.9f);
  material.ambient = Color(0.5f, 0.5f, 0.5f, 1);
  material.emissive = Color(0.1f, 0, 0, 1);
  stage.scene.ambient = Color(0.4f, 0.4f, 0.4f, 1);
  stage.placements = {placed(model_of(floor_of(10), {}, material))};
  const Image image = stage.picture(from_above(3));
  EXPECT_NEAR(image.samples8[image.index(50, 50)], 255.0 * 0.3, 0.51);
  EXPECT_NEAR(image.samples8[image.index(50, 50) + 1], 255.0 * 0.2, 0.51);
}

/// A box of 1 m stands on the floor under a sun at 45 degrees from -x: its shadow reaches from its
/// far face at x = 0.5 to x = 1.5.
TEST(Shading, ShadowFallsWhereTheSunSays) {
  TestStage stage;
  const Pose on_floor{{0, 0, 0.5}, Eigen::Quaterniond::Identity()};
  stage.placements = {placed(model_of(floor_of(20), {}, matt(0.6f))),
                      placed(model_of(Box{{1, 1, 1}}, {}, matt(0.6f)), on_floor)};
  stage.lights = {sun({1, 0, -1})};
  const Camera camera = from_above(8, 401);
  RenderOptions options;
  options.samples = 1;
  const Image image = stage.picture(camera, options);
  const auto brightness = [&](double x, double y) {
    return red_at(image, *camera.project({x, y, 0}));
  };
  const int lit = static_cast<int>(255.0 * 0.6 * std::sqrt(0.5) + 0.5);
  EXPECT_EQ(brightness(1.45, 0.0), 0);
  EXPECT_EQ(brightness(1.55, 0.0), lit);
  EXPECT_EQ(brightness(1.0, 0.45), 0);
  EXPECT_EQ(brightness(1.0, 0.55), lit);
  EXPECT_EQ(brightness(-1.0, 0.0), lit);
  options.shadows = false;
  EXPECT_EQ(red_at(stage.picture(camera, options), *camera.project({1.45, 0, 0})), lit);
  stage.lights[0].cast_shadows = false;
  EXPECT_EQ(red_at(stage.picture(camera), *camera.project({1.45, 0, 0})), lit);
}

TEST(Shading, HalfTransparentLetsTheBackgroundThrough) {
  TestStage stage;
  stage.scene.background = Color(0.8f, 0.8f, 0.8f, 1);
  auto model = model_of(floor_of(10), {}, matt(0));
  model->links[0].visuals[0].transparency = 0.75;
  stage.placements = {placed(model)};
  const Image image = stage.picture(from_above(3));
  EXPECT_NEAR(image.samples8[image.index(50, 50)], 255.0 * 0.8 * 0.75, 0.51);
}

TEST(Shading, PointLightFadesAndEnds) {
  Light light;
  light.type = Light::Type::kPoint;
  light.pose.p = {0, 0, 2};
  light.attenuation_constant = 0.5;
  light.attenuation_linear = 0.25;
  light.attenuation_quadratic = 0.125;
  EXPECT_NEAR(illuminate(light, {0, 0, 0})->color[0], 1.0 / 1.5, 1e-6);
  light.range_m = 1.9;
  EXPECT_FALSE(illuminate(light, {0, 0, 0}).has_value());
}

TEST(Shading, ToneKeepsOrderAndNeverExceedsWhite) {
  EXPECT_FLOAT_EQ(tone(0.5f), 0.5f);
  EXPECT_GT(tone(1.0f), tone(0.9f));
  EXPECT_LE(tone(50.0f), 1.0f);
  EXPECT_NEAR(tone(1.0f), 0.8 + 0.2 * (1.0 - std::pow(16.0 / 17.0, 16)), 1e-6);
  for (double light = 0.8; light < 5.0; light += 0.01) {
    const double exponential = 0.8 + 0.2 * (1.0 - std::exp(-(light - 0.8) / 0.2));
    EXPECT_NEAR(tone(static_cast<float>(light)), exponential, 1.0 / 255.0) << light;
  }
  EXPECT_FLOAT_EQ(tone(-1.0f), 0.0f);
}

TEST(Shading, SameBytesWithAnyNumberOfThreads) {
  TestStage stage;
  stage.placements = {placed(model_of(floor_of(20), {}, matt(0.6f))),
                      placed(model_of(Sphere{1.0}, {}, matt(0.3f)))};
  stage.lights = {sun({1, 0.3, -1})};
  RenderOptions one;
  one.threads = 1;
  RenderOptions many;
  many.threads = 5;
  const Camera camera = from_above(4, 75);
  EXPECT_EQ(stage.picture(camera, one).samples8, stage.picture(camera, many).samples8);
}

}  // namespace
}  // namespace ardee::test
