// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "ardee_sim/core/rng.h"
#include "ardee_sim/raycast/ray_bundle.h"

namespace ardee {
using namespace raycast;
namespace {

constexpr int kRays = 8;
constexpr int kBoxes = 24;

struct Case {
  std::vector<Bounds> boxes;
  RayQuery queries[kRays];
};

/// Returns neighbouring rays among random boxes; some along an axis, some with a component of -0.
Case make_case(std::uint64_t number) {
  const CounterRng rng(stream_key(number, "bundle"));
  std::uint64_t n = 0;
  const auto any = [&](double low, double high) { return low + (high - low) * rng.uniform(n++); };
  const auto anywhere = [&](double size) {
    return Eigen::Vector3d(any(-size, size), any(-size, size), any(-size, size));
  };
  Case made;
  for (int k = 0; k < kBoxes; ++k) {
    const Eigen::Vector3d center = anywhere(2.0);
    Bounds box;
    box.add(center - anywhere(0.8).cwiseAbs());
    box.add(center + anywhere(0.8).cwiseAbs());
    made.boxes.push_back(box);
  }
  const Eigen::Vector3d origin = anywhere(0.5);
  Eigen::Vector3d way = anywhere(1.0).normalized();
  if (number % 4 == 1) way = {1.0, 0.0, 0.0};
  if (number % 4 == 2) way = {0.6, -0.0, -0.8};
  const double spread = number % 2 == 0 ? 0.1 : 0.0;
  for (RayQuery& query : made.queries) {
    const Eigen::Vector3d direction = (way + spread * anywhere(1.0)).normalized();
    query.start({origin + spread * anywhere(0.2), direction}, any(0.5, 3.0), kNoEntity, 0);
  }
  return made;
}

/// Tests points along the ray, 0.5 mm apart, so that no formula can be wrong in the same way.
bool visits(const Bounds& box, const RayQuery& query) {
  for (double t = 0.0; t <= query.reach(); t += 5e-4) {
    const Eigen::Vector3d point = query.ray_W().at(t);
    if ((point - box.lower).minCoeff() >= 0.0 && (box.upper - point).minCoeff() >= 0.0) return true;
  }
  return false;
}

std::vector<std::uint32_t> near_of(const Case& some, int first, int count) {
  BoxTable table;
  for (const Bounds& box : some.boxes) table.add(box);
  std::vector<double> entries;
  std::vector<double> exits;
  std::vector<std::uint32_t> near;
  RayBundle(some.queries + first, count).find(table, entries, exits, near);
  return near;
}

TEST(RayBundle, LeavesOutNoBoxThatARayVisits) {
  int visited = 0;
  for (std::uint64_t number = 0; number < 120; ++number) {
    const Case some = make_case(number);
    const std::vector<std::uint32_t> near = near_of(some, 0, kRays);
    for (std::uint32_t k = 0; k < kBoxes; ++k) {
      const bool met = std::any_of(some.queries, some.queries + kRays, [&](const RayQuery& query) {
        return visits(some.boxes[k], query);
      });
      visited += met ? 1 : 0;
      const auto named = std::count(near.begin(), near.end(), k);
      EXPECT_GE(named, met ? 1 : 0) << number << " box " << k;
    }
  }
  EXPECT_GT(visited, 100);
}

/// With one ray, the bundle is the exact test: a slightly smaller box than each named one is
/// visited.
TEST(RayBundle, NamesForOneRayTheBoxesOnItsWay) {
  for (std::uint64_t number = 0; number < 120; ++number) {
    Case some = make_case(number);
    const std::vector<std::uint32_t> near = near_of(some, 0, 1);
    for (const std::uint32_t k : near) {
      const Bounds grown = some.boxes[k].grown(1e-3);
      EXPECT_TRUE(visits(grown, some.queries[0])) << number << " box " << k;
    }
  }
}

/// A picture's rays count from near to their hits.
TEST(RayBundle, LooksAtRaysOfAPictureFromNearToWhatTheyHaveMet) {
  int visited = 0;
  int left_out = 0;
  for (std::uint64_t number = 0; number < 120; ++number) {
    const Case some = make_case(number);
    const CounterRng rng(stream_key(number, "block"));
    const Eigen::Vector3d eye = some.queries[0].ray_W().origin;
    PrimaryRayPacket block{};
    for (int i = 0; i < PrimaryRayPacket::kRays; ++i) {
      const RayQuery& query = some.queries[i % kRays];
      const auto n = static_cast<std::uint64_t>(3 * i);
      block.set_direction(i, query.ray_W().direction.cast<float>());
      block.near_m[i] = static_cast<float>(0.1 + 0.1 * rng.uniform(n));
      block.far_m[i] = static_cast<float>(0.5 + 2.0 * rng.uniform(n + 1));
      block.range_m[i] = static_cast<float>(0.5 + 2.0 * rng.uniform(n + 2));
    }
    BoxTable table;
    for (const Bounds& box : some.boxes) table.add(box);
    std::vector<double> entries;
    std::vector<double> exits;
    std::vector<std::uint32_t> near;
    RayBundle(eye, block).find(table, entries, exits, near);
    for (std::uint32_t k = 0; k < kBoxes; ++k) {
      bool met = false;
      for (int i = 0; i < PrimaryRayPacket::kRays && !met; ++i) {
        const auto from = static_cast<double>(block.near_m[i]);
        const auto to = static_cast<double>(std::min(block.far_m[i], block.range_m[i]));
        const Eigen::Vector3d way = block.direction_W(i).cast<double>();
        RayQuery query;
        query.start({eye + from * way, way}, to - from, kNoEntity, 0);
        met = visits(some.boxes[k], query);
      }
      visited += met ? 1 : 0;
      const auto named = std::count(near.begin(), near.end(), k);
      left_out += named == 0 ? 1 : 0;
      EXPECT_GE(named, met ? 1 : 0) << number << " box " << k;
    }
  }
  EXPECT_GT(visited, 100);
  EXPECT_GT(left_out, 1000);
}

TEST(RayBundle, LeavesOutWhatAPictureIsTakenFromWithin) {
  PrimaryRayPacket block{};
  for (int i = 0; i < PrimaryRayPacket::kRays; ++i) {
    block.set_direction(i, {1, 0, 0});
    block.near_m[i] = 0.05f;
    block.far_m[i] = 10.0f;
    block.range_m[i] = i == 3 ? 2.0f : 1.0f;
  }
  BoxTable table;
  for (const double x : {0.0, 1.9, 2.2}) {  // about the eye, before and behind what is met
    Bounds box;
    box.add(Eigen::Vector3d(x - 0.04, -0.04, -0.04));
    box.add(Eigen::Vector3d(x + 0.04, 0.04, 0.04));
    table.add(box);
  }
  std::vector<double> entries;
  std::vector<double> exits;
  std::vector<std::uint32_t> near;
  RayBundle({0, 0, 0}, block).find(table, entries, exits, near);
  EXPECT_EQ(near, std::vector<std::uint32_t>{1});
}

TEST(RayBundle, LeavesOutWhatLiesAside) {
  Case some = make_case(1);  // along x
  some.boxes = {Bounds{}, Bounds{}, Bounds{}};
  const Eigen::Vector3d origin = some.queries[0].ray_W().origin;
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.1);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d center = origin + Eigen::Vector3d(k == 0 ? 0.3 : -0.3, k == 2 ? 1 : 0, 0);
    some.boxes[static_cast<std::size_t>(k)].add(center - half);
    some.boxes[static_cast<std::size_t>(k)].add(center + half);
  }
  EXPECT_EQ(near_of(some, 0, kRays), std::vector<std::uint32_t>{0});
}

}  // namespace
}  // namespace ardee
