// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "ardee_sim/core/error.h"
#include "ardee_sim/tools/default_view.h"
#include "ardee_sim/tools/render_arguments.h"

namespace ardee {
using namespace raycast;
using namespace render;
namespace {

RenderArguments parse(std::vector<const char*> words) {
  words.insert(words.begin(), "render_world");
  return parse_render_arguments(static_cast<int>(words.size()), words.data());
}

TEST(RenderArguments, AreRead) {
  const RenderArguments found = parse({"a.world",
                                       "--output",
                                       "a.png",
                                       "--size",
                                       "64x32",
                                       "--look-from",
                                       "0",
                                       "0",
                                       "2",
                                       "--look-at",
                                       "2",
                                       "0",
                                       "-0",
                                       "--collisions",
                                       "--no-shadows",
                                       "--samples",
                                       "9",
                                       "--model-path",
                                       "m",
                                       "--model-path",
                                       "n"});
  EXPECT_EQ(found.world, "a.world");
  EXPECT_EQ(found.model_paths, (std::vector<std::string>{"m", "n"}));
  EXPECT_EQ(found.width, 64);
  EXPECT_EQ(found.height, 32);
  EXPECT_TRUE(found.collisions);
  EXPECT_FALSE(parse({"a.world", "--output", "a.png"}).collisions);
  EXPECT_FALSE(found.shadows);
  EXPECT_EQ(found.samples, 9);
  ASSERT_TRUE(found.camera_W.has_value());
  EXPECT_NEAR(rpy_from_quaternion(found.camera_W->q).y(), 0.78539816, 1e-8);
}

TEST(RenderArguments, WrongOnesAreNamed) {
  const std::vector<std::pair<std::vector<const char*>, std::string>> cases = {
      {{"--output", "a.png"}, "world file"},
      {{"a.world"}, "--output"},
      {{"a.world", "--output", "a.jpg"}, ".png"},
      {{"a.world", "--output", "/no/such/a.png"}, "'/no/such'"},
      {{"a.world", "--output", "a.png", "--size", "12"}, "WIDTHxHEIGHT"},
      {{"a.world", "--output", "a.png", "--size", "0x5"}, "'0'"},
      {{"a.world", "--output", "a.png", "--pose", "1", "2", "x"}, "'x'"},
      {{"a.world", "--output", "a.png", "--pose", "1", "2", "nan"}, "'nan'"},
      {{"a.world", "--output", "a.png", "--pose", "1", "2"}, "nothing after it"},
      {{"a.world", "--output", "a.png", "--look-at", "1", "2", "3"}, "--look-from"},
      {{"a.world", "--output", "a.png", "--fov-deg", "180"}, "175"},
      {{"a.world", "--output", "a.png", "--samples", "-1"}, "'-1'"},
      {{"a.world", "--output", "a.png", "--robot-pose", "0", "0", "0", "0", "0", "0"}, "--robot"},
      {{"a.world", "b.world", "--output", "a.png"}, "'b.world'"},
      {{"a.world", "--output", "a.png", "--colour"}, "'--colour'"}};
  for (const auto& [words, expected] : cases) {
    try {
      parse(words);
      FAIL() << "expected a complaint about " << expected;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  }
}

TEST(DefaultView, ShowsEverythingThatStands) {
  Bounds ground;
  ground.add(Eigen::Vector3d(-500, -500, 0));
  ground.add(Eigen::Vector3d(500, 500, 0.1));
  Bounds things;
  things.add(Eigen::Vector3d(3, -8, 0));
  things.add(Eigen::Vector3d(9, 4, 2));
  Camera camera;
  camera.X_WC = view_over({ground, things}, camera);
  for (int k = 0; k < 8; ++k) {
    const auto seen = camera.project(
        {(k & 1) != 0 ? 3.0 : 9.0, (k & 2) != 0 ? -8.0 : 4.0, (k & 4) != 0 ? 0.0 : 2.0});
    ASSERT_TRUE(seen.has_value());
    EXPECT_GT(seen->minCoeff(), 0.0);
    EXPECT_LT(seen->x(), camera.width);
    EXPECT_LT(seen->y(), camera.height);
  }
  EXPECT_LT((camera.X_WC.p - things.center()).norm(), 40.0);
  camera.X_WC = view_over({ground}, camera);
  EXPECT_GT(camera.X_WC.p.norm(), 500.0);
}

}  // namespace
}  // namespace ardee
