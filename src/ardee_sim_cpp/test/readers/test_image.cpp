// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/heightmap_reader.h"
#include "ardee_sim/readers/image.h"
#include "fixture.h"

namespace ardee {
namespace {

std::string picture(const std::string& name) { return ARDEE_TEST_DATA "/images/" + name; }

// The pictures are 4 x 3 pixels; index = column + 4 * row. Grey of 8 bits is 20 * index, of 16 bits
// 5000 * index.

TEST(Image, ReadsGreyOfEachFormat) {
  for (const char* name : {"grey8.png", "grey8.bmp", "grey8.tga", "grey8.tif", "grey8.jpg"}) {
    const Image image = read_gray_image(picture(name), {});
    ASSERT_EQ(image.width, 4) << name;
    ASSERT_EQ(image.height, 3) << name;
    EXPECT_EQ(image.bits, 8) << name;
    for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(image.samples16[i], 257 * 20 * i) << name;
  }
}

TEST(Image, KeepsSixteenBits) {
  for (const char* name : {"grey16.png", "grey16.tif"}) {
    const Image image = read_gray_image(picture(name), {});
    EXPECT_EQ(image.bits, 16) << name;
    for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(image.samples16[i], 5000 * i) << name;
  }
}

TEST(Image, ReadsColourAndOpacity) {
  const Image image = read_color_image(picture("rgba.png"), {});
  ASSERT_EQ(image.samples8.size(), 48u);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      const int i = column + 4 * row;
      const std::size_t at = image.index(column, row);
      EXPECT_EQ(image.samples8[at], 10 * i);
      EXPECT_EQ(image.samples8[at + 1], 250 - 10 * i);
      EXPECT_EQ(image.samples8[at + 2], 128);
      EXPECT_EQ(image.samples8[at + 3], i == 5 ? 0 : 255);
    }
  }
  EXPECT_EQ(read_color_image(picture("rgb.png"), {}).samples8[3], 255);
  EXPECT_EQ(read_color_image(picture("grey8.png"), {}).samples8[4], 20);
}

TEST(Heightmap, PutsTheUpperEdgeAtPlusY) {
  const HeightGrid grid = read_height_grid(picture("grey16.png"), {30, 20, 6.5535}, {});
  EXPECT_EQ(grid.columns, 4);
  EXPECT_EQ(grid.rows, 3);
  EXPECT_EQ(grid.size_m, Eigen::Vector2d(30, 20));
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      EXPECT_NEAR(grid.at(column, row), 0.5 * (column + 4 * (2 - row)), 1e-6);
    }
  }
}

TEST(Heightmap, ScalesEightBitsTo255) {
  const HeightGrid grid = read_height_grid(picture("grey8.png"), {1, 1, 255}, {});
  EXPECT_NEAR(grid.at(3, 0), 220.0, 1e-4);
}

TEST(Heightmap, NegativeHeightInverts) {
  const HeightGrid grid = read_height_grid(picture("grey8.png"), {1, 1, -255}, {});
  EXPECT_NEAR(grid.at(0, 2), 255.0, 1e-4);
  EXPECT_NEAR(grid.at(3, 0), 35.0, 1e-4);
}

TEST_F(ReadersTest, ReadsTheHeightmapOfListingA23) {
  std::filesystem::create_directories(folder_.path() + "/heightmap_ground/meshes/heightmaps");
  std::filesystem::copy_file(picture("grey8.png"),
                             folder_.path() + "/heightmap_ground/meshes/heightmaps/corn_rows.png");
  const std::string map =
      R"(<uri>file://heightmap_ground/meshes/heightmaps/corn_rows.png</uri><size>30 30 10</size><pos>0 0 -1</pos>)";
  const auto m = model(R"(<static>true</static><link name="link">
      <collision name="collision"><geometry><heightmap>)" +
                       map + R"(</heightmap></geometry></collision>
      <visual name="visual"><geometry><heightmap><use_terrain_paging>false</use_terrain_paging>
        <texture><diffuse>model://images/rgb.png</diffuse><normal>model://images/rgb.png</normal><size>2</size></texture>
        <texture><diffuse>file://nowhere/grass.png</diffuse><size>1</size></texture>
        <blend><min_height>0.5</min_height><fade_dist>1</fade_dist></blend>)" +
                       map + "</heightmap></geometry></visual></link>");
  const auto& seen = std::get<Heightmap>(m->links.at(0).visuals.at(0).geometry);
  const auto& met = std::get<Heightmap>(m->links.at(0).collisions.at(0).geometry);
  EXPECT_EQ(seen.grid, met.grid);
  EXPECT_EQ(met.position_m, Eigen::Vector3d(0, 0, -1));
  ASSERT_EQ(seen.textures.size(), 2u);
  EXPECT_HAS(seen.textures[0].diffuse_path, "images/rgb.png");
  EXPECT_EQ(seen.textures[0].size_m, 2.0);
  EXPECT_EQ(seen.textures[1].diffuse_path, "");
  EXPECT_EQ(seen.blends.at(0).min_height_m, 0.5);
  EXPECT_EQ(seen.blends.at(0).fade_m, 1.0);
  EXPECT_EQ(warnings_->size(), 1u);
  EXPECT_TRUE(warned("found no texture 'file://nowhere/grass.png'"));
}

}  // namespace
}  // namespace ardee
