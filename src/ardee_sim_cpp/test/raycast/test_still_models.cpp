// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "scenes.h"

namespace ardee::test {
using namespace raycast;
namespace {

/// Movable models at rest: boxes of triangles on a grid about the eye, and a row of them beyond its
/// local scene.
class StillModels : public testing::Test {
 protected:
  static constexpr std::uint32_t kNear = 80;
  static constexpr std::uint32_t kFar = 16;

  StillModels() {
    for (std::uint32_t k = 0; k < kNear + kFar; ++k) add(k, place(k));
    prepare(30);
  }

  /// Returns the place of box k; the middle of the grid is free for the eye.
  static Eigen::Vector3d place(std::uint32_t k) {
    if (k >= kNear) return {40.0, k - kNear - 7.5, 0.0};
    const std::uint32_t cell = k < kNear / 2 ? k : k + 1;
    return {2.0 * (cell % 9) - 8.0, 2.0 * (cell / 9) - 8.0, 0.0};
  }

  void add(std::uint32_t k, const Eigen::Vector3d& at_W) {
    test.scene.add_model(k, box);
    move(k, at_W);
  }
  void move(std::uint32_t k, const Eigen::Vector3d& to_W) {
    test.scene.set_link_poses(k, {{to_W, Eigen::Quaterniond::Identity()}});
  }
  void prepare(int times) {
    for (int k = 0; k < times; ++k) test.scene.prepare({eye_W}, true);
  }

  /// Looks all round and expects pictures and shadows equal to those of exact rays. Returns how
  /// many rays hit each model, in the triangle scene or exactly.
  struct Seen {
    std::vector<int> drafted = std::vector<int>(200);
    std::vector<int> exact = std::vector<int>(200);
  };
  Seen trace() {
    prepare(1);
    const RayPattern pattern = random_pattern(16000, 5);
    std::vector<PrimaryRayPacket> blocks = blocks_of(pattern, 0.01f, 100.0f);
    test.scene.pictures().trace_primary(eye_W, blocks.data(), blocks.size());
    std::vector<SceneRay> rays;
    for (const auto& direction_S : pattern.directions_S) {
      rays.push_back({eye_W, direction_S.cast<double>().normalized(), 100.0});
    }
    std::vector<RayHit> hits(rays.size());
    test.scene.pictures().intersect(rays.data(), rays.size(), hits.data());
    Seen seen;
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const PrimaryRayPacket& block = blocks[k / PrimaryRayPacket::kRays];
      const int i = static_cast<int>(k % PrimaryRayPacket::kRays);
      const bool met = hits[k].entity != kNoEntity;
      EXPECT_EQ(block.met(i), met);
      if (!met) continue;
      EXPECT_NEAR(block.range_m[i], hits[k].range_m, 1e-4f);
      const bool exact = (block.surface[i] & PrimaryRayPacket::kOutside) != 0;
      ++(exact ? seen.exact : seen.drafted)[hits[k].entity];
    }
    check_shadows(rays);
    return seen;
  }

  void check_shadows(const std::vector<SceneRay>& rays) {
    std::unique_ptr<bool[]> quick(new bool[rays.size()]);
    std::unique_ptr<bool[]> exact(new bool[rays.size()]);
    test.scene.pictures().find_shadows_approximately(rays.data(), rays.size(), quick.get());
    test.scene.pictures().find_shadows(rays.data(), rays.size(), exact.get());
    EXPECT_TRUE(std::equal(quick.get(), quick.get() + rays.size(), exact.get()));
  }

  bool may_be_shaded(const Eigen::Vector3d& under_W) const {
    const Eigen::Vector3f at_W = (under_W - Eigen::Vector3d(0, 0, 1)).cast<float>();
    return test.scene.pictures().may_be_shaded(eye_W, at_W, {0, 0, 1}, 0.0f);
  }

  const Eigen::Vector3d eye_W{0.1, 0.2, 1.0};
  const std::shared_ptr<Model> box = model_of(mesh_of({box_mesh("box", {0.6f, 0.6f, 0.6f})}));
  TestScene test{SceneKind::kVisual};
};

TEST_F(StillModels, AreOfTheDraftUntilTheyMove) {
  const Seen still = trace();
  for (std::uint32_t k = 0; k < kNear; ++k) {
    EXPECT_GT(still.drafted[k], 0) << k;
    EXPECT_EQ(still.exact[k], 0) << k;
    EXPECT_FALSE(may_be_shaded(place(k)));
  }

  const Eigen::Vector3d to_W = place(41) + Eigen::Vector3d(0, 0.7, 1.0);
  move(41, to_W);
  move(38, place(38) + Eigen::Vector3d(1e-3, 0, 0));
  test.scene.remove_model(30);
  const Seen moved = trace();
  for (std::uint32_t k = 0; k < kNear; ++k) {
    const bool has_moved = k == 41 || k == 38;
    EXPECT_EQ(moved.drafted[k] > 0, !has_moved && k != 30) << k;
    EXPECT_EQ(moved.exact[k] > 0, has_moved) << k;
    EXPECT_EQ(may_be_shaded(place(k)), has_moved || k == 30) << k;
  }
  EXPECT_TRUE(may_be_shaded(to_W));
}

TEST_F(StillModels, AreAskedForByTheTreeWhileManyMove) {
  for (std::uint32_t k = 0; k < kNear; ++k) move(k, place(k) + Eigen::Vector3d(0, 0, 1e-3));
  const Seen seen = trace();
  for (std::uint32_t k = 0; k < kNear; ++k) {
    EXPECT_EQ(seen.drafted[k], 0) << k;
    EXPECT_GT(seen.exact[k], 0) << k;
  }
}

TEST_F(StillModels, JoinTheDraftWhereManyHaveComeToRest) {
  for (std::uint32_t k = 0; k < 20; ++k) {
    add(100 + k, {k - 9.5, 1.0, 3.0});
  }
  EXPECT_GT(trace().exact[110], 0);
  prepare(120);
  const Seen seen = trace();
  for (std::uint32_t k = 0; k < 20; ++k) {
    EXPECT_GT(seen.drafted[100 + k], 0) << k;
    EXPECT_EQ(seen.exact[100 + k], 0) << k;
  }
}

TEST_F(StillModels, AreSeenBeyondTheNearRegion) {
  const Seen seen = trace();
  int far = 0;
  for (std::uint32_t k = kNear; k < kNear + kFar; ++k) {
    EXPECT_EQ(seen.drafted[k], 0) << k;
    far += seen.exact[k];
  }
  EXPECT_GT(far, 0);
}

TEST_F(StillModels, AreGoneWithTheLastOfThem) {
  for (std::uint32_t k = 0; k < kNear + kFar; ++k) test.scene.remove_model(k);
  const Seen seen = trace();
  EXPECT_EQ(std::count(seen.drafted.begin(), seen.drafted.end(), 0), 200);
  EXPECT_EQ(std::count(seen.exact.begin(), seen.exact.end(), 0), 200);
}

}  // namespace
}  // namespace ardee::test
