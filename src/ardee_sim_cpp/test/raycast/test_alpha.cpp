// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "ardee_sim/raycast/alpha_mask.h"
#include "scenes.h"

namespace ardee::test {
using namespace raycast;
namespace {

/// Writes an uncompressed TGA of 2 x 2 texels with the given opacities, upper row first.
std::string write_texture(const std::array<unsigned char, 4>& opacity) {
  const std::string path =
      (std::filesystem::path(::testing::TempDir()) / "alpha_mask.tga").string();
  std::array<unsigned char, 18> header{};
  header[2] = 2;      // true colour
  header[12] = 2;     // width
  header[14] = 2;     // height
  header[16] = 32;    // bits
  header[17] = 0x28;  // 8 bits of opacity, upper row first
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(header.data()), header.size());
  for (const unsigned char each : opacity) {
    const std::array<unsigned char, 4> texel{10, 200, 10, each};
    file.write(reinterpret_cast<const char*>(texel.data()), texel.size());
  }
  return path;
}

/// Returns the square [-1, 1]^2 in the yz plane, textured once: u along y, v along z.
Mesh textured_square() {
  SubMesh part;
  part.name = "leaf";
  part.vertices = {{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}};
  part.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  part.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh_of({part});
}

class Alpha : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(NearAndFar, Alpha, ::testing::Bool());

TEST_P(Alpha, TexelsBelowTheRejectionAreHoles) {
  Material material = two_sided();
  // Opacities: upper left 255, upper right 0, lower left 128, lower right 127.
  material.texture_path = write_texture({255, 0, 128, 127});
  material.alpha_rejection = 127.5f / 255.0f;
  RayOptions options;
  options.local_scenes = GetParam();
  const auto met = [&](SceneKind kind, double y, double z) {
    TestScene scene(kind, options, 0, {placed(model_of(textured_square(), {}, material))});
    return std::isfinite(scene.one({3, y, z}, {-1, 0, 0}).range_m);
  };
  EXPECT_TRUE(met(SceneKind::kVisual, -0.5, 0.6));
  EXPECT_FALSE(met(SceneKind::kVisual, 0.5, 0.6));
  EXPECT_TRUE(met(SceneKind::kVisual, -0.5, -0.6));
  EXPECT_FALSE(met(SceneKind::kVisual, 0.5, -0.6));
  EXPECT_TRUE(met(SceneKind::kCollision, 0.5, 0.6));
  material.alpha_rejection = -1.0f;
  EXPECT_TRUE(met(SceneKind::kVisual, 0.5, 0.6));
}

TEST(AlphaMask, TexelsNotAboveTheRejectionAreHoles) {
  EXPECT_TRUE(AlphaMask(write_texture({255, 0, 128, 127}), 0.0f).has_holes());
  EXPECT_FALSE(AlphaMask(write_texture({255, 1, 128, 127}), 0.001f).has_holes());
}

TEST_P(Alpha, TextureThatCannotBeReadIsOpaqueAndSaid) {
  Material material = two_sided();
  material.texture_path = "/no/such/texture.png";
  material.alpha_rejection = 0.5f;
  std::vector<std::string> messages;
  RayScene scene(SceneKind::kVisual, {},
                 Log([&](LogLevel, const std::string& text) { messages.push_back(text); }));
  const auto model = model_of(textured_square(), {}, material);
  scene.add_scenery(0, {placed(model), placed(model_of(textured_square(), {}, material))});
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].find("/no/such/texture.png"), std::string::npos);
  std::vector<std::string> again;  // of a scene that shares the body
  RayScene other(SceneKind::kVisual, {},
                 Log([&](LogLevel, const std::string& text) { again.push_back(text); }));
  other.add_scenery(0, {placed(model)});
  EXPECT_EQ(again, messages);
  scene.prepare({{3, 0, 0}});
  std::vector<RayHit> hits;
  scene.cast({{3, 0.5, 0.6}, Eigen::Quaterniond::Identity()}, towards({-1, 0, 0}), 9, kNoEntity, 0,
             hits);
  EXPECT_FLOAT_EQ(hits[0].range_m, 3.0f);
}

}  // namespace
}  // namespace ardee::test
