// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include "ardee_sim/description/shape_fault.h"

namespace ardee {
namespace {

std::string field_of(const Geometry& geometry) {
  const auto fault = find_fault(geometry);
  return fault ? fault->field : "";
}

Heightmap heightmap(const HeightGrid& grid) {
  Heightmap made;
  made.grid = std::make_shared<HeightGrid>(grid);
  return made;
}

TEST(ShapeFault, NamesTheField) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Mesh mesh;
  EXPECT_EQ(field_of(mesh), "uri");
  mesh.file = std::make_shared<MeshFile>();
  EXPECT_EQ(field_of(mesh), "");
  mesh.scale = {1.0, -1.0, 0.0};
  EXPECT_EQ(field_of(mesh), "scale");

  EXPECT_EQ(field_of(Box{}), "");
  EXPECT_EQ(field_of(Box{{1.0, 0.0, 1.0}}), "size");
  EXPECT_EQ(field_of(Sphere{kNan}), "radius");
  EXPECT_EQ(field_of(Cylinder{kInfinity, 1.0}), "radius");
  EXPECT_EQ(field_of(Cylinder{1.0, -1.0}), "length");
  EXPECT_EQ(field_of(Plane{}), "");
  EXPECT_EQ(field_of(Plane{{0.0, 0.0, 0.0}, {1.0, 1.0}}), "normal");
  EXPECT_EQ(field_of(Plane{{0.0, 0.0, 1.0}, {1.0, 0.0}}), "size");
}

TEST(ShapeFault, AHeightmapNeedsAllItsHeights) {
  EXPECT_EQ(field_of(Heightmap{}), "uri");
  EXPECT_EQ(field_of(heightmap({2, 2, {1.0, 1.0}, {0, 0, 0, 0}})), "");
  EXPECT_EQ(field_of(heightmap({2, 2, {1.0, 1.0}, {0, 0, 0}})), "uri");
  EXPECT_EQ(field_of(heightmap({1, 4, {1.0, 1.0}, {0, 0, 0, 0}})), "uri");
  EXPECT_EQ(field_of(heightmap({2, 2, {1.0, 0.0}, {0, 0, 0, 0}})), "size");
  EXPECT_EQ(
      field_of(heightmap({2, 2, {1.0, 1.0}, {0, std::numeric_limits<float>::infinity(), 0, 0}})),
      "uri");
}

TEST(ShapeFault, SaysWhatIsExpected) {
  EXPECT_EQ(find_fault(Sphere{-1.0})->message(),
            "found an invalid radius, expected a positive number");
}

}  // namespace
}  // namespace ardee
