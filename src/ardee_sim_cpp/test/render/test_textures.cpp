// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "pictures.h"

namespace ardee::test {
using namespace render;
namespace {

/// Writes a picture with the colours of `color_of(column, row)`, and returns its path.
std::string write_texture(const std::string& name, int side,
                          const std::function<Eigen::Vector3i(int, int)>& color_of) {
  Image image;
  image.width = image.height = side;
  for (int k = 0; k < side * side; ++k) {
    const Eigen::Vector3i color = color_of(k % side, k / side);
    for (int c = 0; c < 3; ++c) image.samples8.push_back(static_cast<std::uint8_t>(color[c]));
    image.samples8.push_back(255);
  }
  const std::string path = (std::filesystem::path(::testing::TempDir()) / name).string();
  write_png(path, image);
  return path;
}

Material glowing(const std::string& texture) {
  Material material;
  material.ambient = material.diffuse = Color::Ones();
  material.texture_path = texture;
  return material;
}

/// The one black field in a white board of 8 x 8 fields appears where the camera's formula puts it.
TEST(Textures, FieldOfABoardProjectsToItsPixel) {
  const std::string path = write_texture("board.png", 64, [](int column, int row) {
    const bool black = column / 8 == 6 && row / 8 == 1;
    return Eigen::Vector3i::Constant(black ? 0 : 200).eval();
  });
  TestStage stage;
  stage.scene.ambient = Color::Ones();
  Plane board;
  board.size_m = {4, 4};
  stage.placements = {placed(model_of(board, {}, glowing(path)))};
  Camera camera;
  camera.X_WC = look_at({-2, -4, 3}, {0.5, 0.5, 0});
  const Image image = stage.picture(camera);
  // The field is in column 6 of 8 from x = -2 on; row 1 from the upper edge, y = 2, on.
  const auto shown = [&](double x, double y) { return red_at(image, *camera.project({x, y, 0})); };
  EXPECT_LT(shown(1.25, 1.25), 5);
  for (const Eigen::Vector2d& next : {Eigen::Vector2d(0.85, 1.25), Eigen::Vector2d(1.65, 1.25),
                                      Eigen::Vector2d(1.25, 0.85), Eigen::Vector2d(1.25, 1.65)}) {
    EXPECT_NEAR(shown(next.x(), next.y()), 200, 5);
  }
}

TEST(Textures, FromFarTheyAreTheirMean) {
  Image image;
  image.width = image.height = 16;
  for (int k = 0; k < 256; ++k) {
    const std::uint8_t value = (k + k / 16) % 2 != 0 ? 200 : 100;
    image.samples8.insert(image.samples8.end(), {value, value, value, 255});
  }
  const Texture texture(image);
  EXPECT_NEAR(texture.color({0.3, 0.7}, 1.0)[0], 150.0 / 255.0, 1e-5);
  EXPECT_NEAR(texture.color({0.5 / 16, 15.5 / 16}, 0.0)[0], 100.0 / 255.0, 1e-5);
  EXPECT_NEAR(texture.color({1.5 / 16 - 4.0, 15.5 / 16 + 2.0}, 0.0)[0], 200.0 / 255.0, 1e-5);
}

TEST(Textures, GroundBlendsByHeight) {
  const auto plain = [](const std::string& name, const Eigen::Vector3i& color) {
    return write_texture(name, 2, [color](int, int) { return color; });
  };
  auto grid = std::make_shared<HeightGrid>();
  grid->columns = grid->rows = 2;
  grid->size_m = {10, 10};
  grid->heights_m = {0, 1, 0, 1};  // rises along x
  Heightmap map;
  map.grid = grid;
  map.textures = {{plain("low.png", {200, 0, 0}), 1.0}, {plain("high.png", {0, 200, 0}), 1.0}};
  map.blends = {{0.4, 0.2}};
  TestStage stage;
  stage.scene.ambient = Color::Ones();
  stage.placements = {placed(model_of(map))};
  const Camera camera = from_above(5, 201);
  const Image image = stage.picture(camera);
  const auto colors = [&](double x) {
    const Eigen::Vector2d px = *camera.project({x, 0, 0.5 + 0.1 * x});
    const std::size_t at = image.index(static_cast<int>(px.x()), static_cast<int>(px.y()));
    return std::make_pair(int{image.samples8[at]}, int{image.samples8[at + 1]});
  };
  EXPECT_EQ(colors(-1.5), std::make_pair(200, 0));
  EXPECT_EQ(colors(1.5), std::make_pair(0, 200));
  EXPECT_NEAR(colors(0.0).first, 100, 6);
  EXPECT_NEAR(colors(0.0).second, 100, 6);
}

TEST(Textures, PngBytesRepeat) {
  const auto color = [](int column, int row) { return Eigen::Vector3i(column, row, 7); };
  const std::string first = write_texture("first.png", 32, color);
  const std::string second = write_texture("second.png", 32, color);
  const Image back = read_color_image(first, {first, 0, ""});
  EXPECT_EQ(back.samples8[back.index(3, 5)], 3);
  EXPECT_EQ(back.samples8[back.index(3, 5) + 1], 5);
  EXPECT_EQ(std::filesystem::file_size(first), std::filesystem::file_size(second));
  EXPECT_THROW(write_png("/no/such/folder/picture.png", back), Error);
}

}  // namespace
}  // namespace ardee::test
