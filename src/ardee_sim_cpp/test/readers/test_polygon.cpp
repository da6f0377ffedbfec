// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "ardee_sim/core/rng.h"
#include "ardee_sim/readers/polygon.h"

namespace ardee {
namespace {

using Corners = std::vector<Eigen::Vector3f>;

/// Returns half the sum of cross products (the shoelace formula).
Eigen::Vector3d area_of(const Corners& corners) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Eigen::Vector3f& next = corners[(k + 1) % corners.size()];
    sum += 0.5 * corners[k].cast<double>().cross(next.cast<double>());
  }
  return sum;
}

/// Expects triangles that turn as the polygon does and cover its area, none outside of it or over
/// another.
void expect_cut(const Corners& corners) {
  const Eigen::Vector3d whole = area_of(corners);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& t : cut_polygon(corners)) {
    const Corners triangle{corners[t[0]], corners[t[1]], corners[t[2]]};
    EXPECT_GT(area_of(triangle).dot(whole), 0.0);
    sum += area_of(triangle);
  }
  EXPECT_LT((sum - whole).norm(), 1e-5 * whole.norm());
}

/// Cuts the polygon in other planes, turned the other way and begun at each corner.
void expect_cut_however(const Corners& corners) {
  for (const Eigen::Vector3f& axis : {Eigen::Vector3f(0, 0, 1), Eigen::Vector3f(1, 0, 0),
                                      Eigen::Vector3f(0, 1, 0), Eigen::Vector3f(1, 2, 3)}) {
    const auto q = Eigen::Quaternionf::FromTwoVectors(Eigen::Vector3f::UnitZ(), axis);
    Corners turned;
    for (const Eigen::Vector3f& corner : corners) turned.push_back(q * corner);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      expect_cut(turned);
      std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    }
    std::reverse(turned.begin(), turned.end());
    expect_cut(turned);
  }
}

TEST(Polygon, IsCutWhetherConvexOrNot) {
  expect_cut_however({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  expect_cut_however({{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5f, 1, 0}});
  expect_cut_however({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}});
  expect_cut_however(
      {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});
}

TEST(Polygon, MayHaveCornersOnItsSides) {
  expect_cut_however({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}});
}

TEST(Polygon, MayHaveAHoleThatASlitLeadsTo) {
  expect_cut({{0, 0, 0},
              {4, 0, 0},
              {4, 4, 0},
              {0, 4, 0},
              {0, 0, 0},
              {1, 1, 0},
              {1, 3, 0},
              {3, 3, 0},
              {3, 1, 0},
              {1, 1, 0}});
}

TEST(Polygon, MayBeAnyStar) {
  Rng rng(mix_bits(5));
  for (int star = 0; star < 300; ++star) {
    Corners corners;
    const int count = 4 + star % 30;
    for (int k = 0; k < count; ++k) {
      const double angle = 2.0 * M_PI * k / count;
      const double radius = 0.1 + 0.9 * rng.uniform();
      corners.emplace_back(static_cast<float>(radius * std::cos(angle)),
                           static_cast<float>(radius * std::sin(angle)), 3.0f);
    }
    expect_cut(corners);
  }
}

TEST(Polygon, MayBeASpiral) {
  Corners corners;
  for (int k = 0; k < 60; ++k) {
    const float angle = 0.3f * static_cast<float>(k);
    corners.emplace_back((1.0f + 0.2f * angle) * std::cos(angle),
                         (1.0f + 0.2f * angle) * std::sin(angle), 0.0f);
  }
  for (int k = 60; k-- > 0;) {
    const float angle = 0.3f * static_cast<float>(k);
    corners.emplace_back((0.5f + 0.2f * angle) * std::cos(angle),
                         (0.5f + 0.2f * angle) * std::sin(angle), 0.0f);
  }
  expect_cut(corners);
}

TEST(Polygon, WithoutAreaHasNoTriangles) {
  EXPECT_TRUE(cut_polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).empty());
  EXPECT_TRUE(cut_polygon({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}).empty());
  EXPECT_TRUE(cut_polygon({{0, 0, 0}, {1, 0, 0}}).empty());
}

TEST(Polygon, ThatCrossesItselfStillEnds) {
  Rng rng(mix_bits(6));
  Corners corners;
  for (int k = 0; k < 200; ++k) {
    corners.emplace_back(static_cast<float>(rng.uniform()), static_cast<float>(rng.uniform()),
                         0.0f);
  }
  EXPECT_LE(cut_polygon(corners).size(), corners.size() - 2);
}

}  // namespace
}  // namespace ardee
