// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <limits>

#include "ardee_sim/core/text_file.h"
#include "ardee_sim/image/image.h"
#include "ardee_sim/readers/heightmap_reader.h"
#include "fixture.h"

namespace ardee {
namespace {

std::string picture(const std::string& name) { return test_data("images/" + name); }

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

/// The values of a heightmap are not brightness, whatever gamma the file names.
TEST(Image, DoesNotCorrectGamma) {
  const TempFolder folder;
  std::string png = read_text_file(picture("grey8.png"), {}, 10'000);
  constexpr std::size_t kBehindHeader = 33;
  png.insert(kBehindHeader, std::string("\0\0\0\x04gAMA\0\x01\x86\xa0\x31\xe8\x96\x5f", 16));
  const Image image = read_gray_image(folder.write("linear.png", png), {});
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(image.samples16.at(i), 257 * 20 * i);
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

TEST(Image, ReadsColourOfEachFormat) {
  const Image expected = read_color_image(picture("rgba.png"), {});
  for (const char* name : {"rgba.tga", "rgba.tif"}) {
    EXPECT_EQ(read_color_image(picture(name), {}).samples8, expected.samples8) << name;
  }
  const Image opaque = read_color_image(picture("rgb.png"), {});
  for (const char* name : {"rgb.bmp", "rgb.tga", "rgb.tif", "palette.png"}) {
    EXPECT_EQ(read_color_image(picture(name), {}).samples8, opaque.samples8) << name;
  }
  for (const char* name : {"flat.jpg", "cmyk.jpg"}) {
    const Image image = read_color_image(picture(name), {});
    EXPECT_NEAR(image.samples8.at(0), 200, 2) << name;
    EXPECT_NEAR(image.samples8.at(1), 100, 2) << name;
    EXPECT_NEAR(image.samples8.at(2), 50, 2) << name;
    EXPECT_EQ(image.samples8.at(3), 255) << name;
  }
}

TEST(Image, HoldsALargeGreyOne) {
  const Image image = read_gray_image(picture("black8000.png"), {});
  EXPECT_EQ(image.width, 8000);
  EXPECT_EQ(image.samples16.size(), 64'000'000u);
  EXPECT_EQ(*std::max_element(image.samples16.begin(), image.samples16.end()), 0);
}

/// Heights of a file, and the messages about it.
struct Heights {
  Heights(const std::string& path, const Eigen::Vector3d& size_m)
      : log([this](LogLevel, const std::string& text) { said += text; }),
        grid(read_height_grid(path, size_m, Source{"test", 1, "uri"}, log)) {}

  std::string said;
  Log log;
  HeightGrid grid;
};

std::string little(std::uint32_t value, int bytes) {
  std::string text;
  for (int k = 0; k < bytes; ++k) text += static_cast<char>(value >> (8 * k) & 0xFFu);
  return text;
}

/// Returns a grey TGA of 8 bits and two columns, from the upper edge.
std::string tga(const std::string& pixels) {
  return std::string("\0\0\3\0\0\0\0\0\0\0\0\0", 12) + little(2, 2) +
         little(static_cast<std::uint32_t>(pixels.size() / 2), 2) + little(8, 1) + little(0x20, 1) +
         pixels;
}

enum class Samples : std::uint32_t { kUnsigned = 1, kSigned = 2, kFloat = 3 };

/// Returns a TIFF of two columns and one strip, with GDAL's tag for no data and a GeoTIFF's keys if
/// asked.
template <typename Number>
std::string tiff(Samples format, const std::vector<Number>& samples,
                 const std::string& no_data = "", bool is_geo = false,
                 std::uint32_t orientation = 1) {
  std::string bytes;
  for (const Number sample : samples) {
    bytes.append(reinterpret_cast<const char*>(&sample), sizeof(sample));
  }
  const auto rows = static_cast<std::uint32_t>(samples.size() / 2);
  std::string entries;
  std::uint32_t count = 0;
  const auto entry = [&](std::uint32_t tag, std::uint32_t type, std::uint32_t n,
                         std::uint32_t value) {
    entries += little(tag, 2) + little(type, 2) + little(n, 4) + little(value, 4);
    ++count;
  };
  const auto length = static_cast<std::uint32_t>(bytes.size());
  entry(256, 3, 1, 2);
  entry(257, 3, 1, rows);
  entry(258, 3, 1, 8 * sizeof(Number));
  entry(259, 3, 1, 1);
  entry(262, 3, 1, 1);
  entry(273, 4, 1, 8);
  entry(274, 3, 1, orientation);
  entry(277, 3, 1, 1);
  entry(278, 3, 1, rows);
  entry(279, 4, 1, length);
  entry(339, 3, 1, static_cast<std::uint32_t>(format));
  if (is_geo) entry(34735, 3, 4, 8 + length);
  const std::uint32_t text_at = 8 + length + 8;
  if (!no_data.empty()) {
    entry(42113, 2, static_cast<std::uint32_t>(no_data.size() + 1), text_at);
  }
  const std::string head = std::string("II*\0", 4);
  const std::string after = little(1, 2) + little(1, 2) + little(0, 4) + no_data + '\0' +
                            std::string(no_data.size() % 2 == 0 ? 1 : 0, '\0');
  return head + little(8 + length + static_cast<std::uint32_t>(after.size()), 4) + bytes + after +
         little(count, 2) + entries + little(0, 4);
}

/// Returns the heights row by row from the upper edge, as in the file.
std::vector<float> as_written(const HeightGrid& grid) {
  std::vector<float> heights;
  for (int row = grid.rows - 1; row >= 0; --row) {
    for (int column = 0; column < grid.columns; ++column) heights.push_back(grid.at(column, row));
  }
  return heights;
}

void expect_heights(const HeightGrid& grid, const std::vector<float>& expected) {
  const std::vector<float> found = as_written(grid);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-5f) << k;
}

TEST(Heightmap, PutsTheUpperEdgeAtPlusY) {
  const HeightGrid grid = Heights(picture("grey16.png"), {30, 20, 6.5535}).grid;
  EXPECT_EQ(grid.columns, 4);
  EXPECT_EQ(grid.rows, 3);
  EXPECT_EQ(grid.size_m, Eigen::Vector2d(30, 20));
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      EXPECT_NEAR(grid.at(column, row), 0.5 * (column + 4 * (2 - row)), 1e-6);
    }
  }
}

TEST(Heightmap, TheBrightestOfEightBitsStandsAtSizeZ) {
  for (const char* name : {"grey8.png", "grey8.bmp", "grey8.tga", "grey8.tif", "grey8.jpg"}) {
    const HeightGrid grid = Heights(picture(name), {1, 1, 11}).grid;
    for (int column = 0; column < 4; ++column) EXPECT_NEAR(grid.at(column, 0), 8 + column, 1e-4);
  }
  const TempFolder folder;
  const auto heights = [&](const std::string& pixels) {
    return Heights(folder.write("h.tga", tga(pixels)), {1, 1, 10}).grid;
  };
  expect_heights(heights(std::string("\0\x02\x01\x01", 4)), {0, 10, 5, 5});
  expect_heights(heights(std::string("\0\xff\x33\x01", 4)), {0, 10, 2, 10 / 255.0f});
  // A brightest value of 1 is Gazebo's full scale: 1 of 255 stays as high.
  expect_heights(heights(std::string("\0\x01\x01\0", 4)), {0, 10 / 255.0f, 10 / 255.0f, 0});
  expect_heights(heights(std::string(4, '\0')), {0, 0, 0, 0});
  expect_heights(heights("@@@@"), {10, 10, 10, 10});
}

TEST(Heightmap, WhiteOfSixteenBitsStandsAtSizeZ) {
  const TempFolder folder;
  const std::string path =
      folder.write("h.tif", tiff<std::uint16_t>(Samples::kUnsigned, {0, 257, 13107, 257 * 100}));
  expect_heights(Heights(path, {1, 1, 10}).grid, {0, 10 / 255.0f, 2, 1000 / 255.0f});
}

TEST(Heightmap, NegativeHeightInverts) {
  const HeightGrid grid = Heights(picture("grey8.png"), {1, 1, -11}).grid;
  EXPECT_NEAR(grid.at(0, 2), 11.0, 1e-4);
  EXPECT_NEAR(grid.at(3, 0), 0.0, 1e-4);
}

TEST(Heightmap, SpansSizeZFromTheLeastToTheGreatestElevation) {
  const TempFolder folder;
  const auto heights = [&](const std::string& bytes) {
    const Heights read(folder.write("e.tif", bytes), {1, 1, 4.2});
    EXPECT_EQ(read.said, "");
    return read.grid;
  };
  expect_heights(heights(tiff<float>(Samples::kFloat, {0.2f, 4.4f, 2.3f, 0.2f})),
                 {0, 4.2f, 2.1f, 0});
  expect_heights(heights(tiff<double>(Samples::kFloat, {-1, 3.2, 1.1, 0})), {0, 4.2f, 2.1f, 1});
  expect_heights(heights(tiff<std::int16_t>(Samples::kSigned, {-10, 11, 1, 0})),
                 {0, 4.2f, 2.2f, 2});
  expect_heights(heights(tiff<std::int32_t>(Samples::kSigned, {800, 821, 801, 800})),
                 {0, 4.2f, 0.2f, 0});
  expect_heights(heights(tiff<std::uint16_t>(Samples::kUnsigned, {800, 821, 801, 800}, "", true)),
                 {0, 4.2f, 0.2f, 0});
  expect_heights(heights(tiff<float>(Samples::kFloat, {7, 7, 7, 7})), {0, 0, 0, 0});
}

TEST(Heightmap, TakesTheLeastWhereThereIsNoElevation) {
  const TempFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const std::string& bytes :
       {tiff<float>(Samples::kFloat, {1, 3, nan, 2}),
        tiff<float>(Samples::kFloat, {1, 3, -3.4e38f, 2}),
        tiff<float>(Samples::kFloat, {1, 3, -9999, 2}, "-9999"),
        tiff<std::int16_t>(Samples::kSigned, {1, 3, -32768, 2}, "-32768")}) {
    const std::string path = folder.write("e.tif", bytes);
    const Heights read(path, {1, 1, 2});
    expect_heights(read.grid, {0, 2, 0, 1});
    EXPECT_EQ(read.said, "test:1: <uri>: 1 pixels of '" + path +
                             "' have no elevation, the least of the others is used");
  }
  const std::string none =
      folder.write("n.tif", tiff<float>(Samples::kFloat, {nan, nan, nan, nan}));
  EXPECT_THROW(Heights(none, {1, 1, 1}), Error);
}

TEST(Heightmap, RefusesABrokenElevationFile) {
  const TempFolder folder;
  const std::string whole = tiff<float>(Samples::kFloat, {1, 2, 3, 4});
  for (std::size_t length = 9; length + 4 < whole.size(); ++length) {
    const std::string path = folder.write("t.tif", whole.substr(0, length));
    EXPECT_THROW(Heights(path, {1, 1, 1}), Error) << length;
  }
}

TEST(Heightmap, RefusesElevationsThatDoNotBeginAtTheUpperLeft) {
  const TempFolder folder;
  const std::string path =
      folder.write("o.tif", tiff<float>(Samples::kFloat, {1, 2, 3, 4}, "", false, 4));
  try {
    const Heights heights(path, {1, 1, 1});
    FAIL();
  } catch (const Error& error) {
    EXPECT_HAS(error.what(), "found elevations of orientation 4");
  }
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
        <texture><diffuse>file://nowhere/grass.png</diffuse>
          <normal>file://media/materials/textures/flat_normal.png</normal><size>1</size></texture>
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
  EXPECT_EQ(warnings_->size(), 2u);
  EXPECT_TRUE(warned("<normal>: has no effect: there are no normal maps"));
  EXPECT_TRUE(warned("found no texture 'file://nowhere/grass.png'"));
}

}  // namespace
}  // namespace ardee
