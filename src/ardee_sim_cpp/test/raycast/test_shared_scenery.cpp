// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <future>
#include <thread>

#include "ardee_sim/raycast/embree_scene.h"
#include "ardee_sim/raycast/fixed_scenery.h"
#include "ardee_sim/raycast/traceable_compiler.h"
#include "scenes.h"

namespace ardee::test {
namespace {

const Eigen::Vector3d kEye{5.1, 5.2, 0.3};

/// Returns 2,500 places of one description, a body of 600 triangles.
std::vector<Placement> field() {
  std::vector<SubMesh> parts;
  for (int k = 0; k < 50; ++k) {
    const float z = 0.02f * static_cast<float>(k);
    parts.push_back(box_mesh("part", {0.05f, 0.02f, 0.01f}, {0, 0, z}));
  }
  const auto model = model_of(mesh_of(parts));
  std::vector<Placement> placements;
  for (int k = 0; k < 2500; ++k) {
    const Eigen::Vector3d place(0.4 * (k % 50), 0.4 * (k / 50), 0);
    placements.push_back(placed(model, {place, Eigen::Quaterniond::Identity()}));
  }
  return placements;
}

std::vector<float> ranges_from(TestScene& scene, const Eigen::Vector3d& eye_W = kEye) {
  std::vector<float> ranges;
  const Pose X_WS{eye_W, Eigen::Quaterniond::Identity()};
  for (const RayHit& hit : scene.cast(X_WS, fan(541, -2.3, 2.3))) ranges.push_back(hit.range_m);
  return ranges;
}

class SharedSceneryBytes : public testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Pictures, SharedSceneryBytes, testing::Bool());

TEST_P(SharedSceneryBytes, OfASecondSceneAreNone) {
  const auto placements = field();
  const std::size_t none = embree_bytes();
  TestScene first(SceneKind::kVisual, {}, 0, placements);
  first.scene.prepare({kEye}, GetParam());
  const std::size_t one = embree_bytes();
  TestScene second(SceneKind::kVisual, {}, 0, placements);
  second.scene.prepare({kEye}, GetParam());
  EXPECT_GT(one, none + 100'000);
  EXPECT_EQ(embree_bytes(), one);
}

TEST(SharedScenery, LastsNoLongerThanItsScenes) {
  const std::size_t none = embree_bytes();
  {
    TestScene scene(SceneKind::kVisual, {}, 0, field());
    scene.scene.prepare({kEye}, true);
    EXPECT_GT(embree_bytes(), none);
  }
  EXPECT_EQ(embree_bytes(), none);
}

TEST(SharedScenery, IsTheSameForEqualGroupsAlone) {
  Log log;
  const auto model = model_of(Box{{0.1, 0.1, 0.1}});
  const auto group = [&](double x_m) {
    auto made = std::make_shared<SceneryGroup>();
    made->count = 1;
    made->bodies.push_back(compile_model(model, SceneKind::kVisual, log));
    made->placed.push_back({made->bodies[0].get(), {x_m, 0, 0}});
    return FixedScenery::Groups{made};
  };
  const auto scenery = FixedScenery::of(group(1.0));
  EXPECT_EQ(FixedScenery::of(group(1.0)), scenery);
  EXPECT_NE(FixedScenery::of(group(1.5)), scenery);
  EXPECT_NE(FixedScenery::of({}), scenery);
}

TEST(SharedScenery, OfOneSceneStaysWhenAnotherLosesIt) {
  const auto placements = field();
  TestScene stays(SceneKind::kVisual, {}, 0, placements);
  TestScene loses(SceneKind::kVisual, {}, 0, placements);
  const auto before = ranges_from(stays);
  EXPECT_EQ(ranges_from(loses), before);
  loses.scene.remove_scenery(0);
  EXPECT_EQ(ranges_from(loses), std::vector<float>(541, kInfinity));
  EXPECT_EQ(ranges_from(stays), before);
}

/// A scan of another scene may have left a local scene with another centre.
TEST(SharedScenery, OfScansIsNotThatOfPictures) {
  const auto placements = field();
  const auto picture = [&](bool beside_another) {
    TestScene other(SceneKind::kVisual, {}, 0, placements);
    TestScene scene(SceneKind::kVisual, {}, 0, placements);
    if (beside_another) ranges_from(other, kEye + Eigen::Vector3d(0.4, 0.3, 0));
    ranges_from(scene);
    std::vector<std::uint64_t> numbers;
    for (int k = 0; k < 20; ++k) {
      const Eigen::Vector3d eye_W = kEye + Eigen::Vector3d(0.3 * k, 0, 0);
      scene.scene.prepare({eye_W}, true);
      auto blocks = blocks_of(random_pattern(4096, 3), 0.05f, 50.0f);
      scene.scene.pictures().trace_primary(eye_W, blocks.data(), blocks.size());
      for (const PrimaryRayPacket& block : blocks) {
        for (int i = 0; i < PrimaryRayPacket::kRays; ++i) {
          std::uint32_t bits;
          std::memcpy(&bits, &block.range_m[i], sizeof bits);
          numbers.push_back(bits);
        }
      }
    }
    return numbers;
  };
  EXPECT_EQ(picture(true), picture(false));
}

/// Returns how many local scenes were in use so far at each of some places, 5 cm apart, of a camera
/// whose local scenes reach some 2 m.
std::vector<std::size_t> taken_on_the_way(std::chrono::milliseconds pause) {
  RayOptions options;
  options.local_scene_budget_bytes = 16u << 20;
  TestScene scene(SceneKind::kVisual, options, 0, field());
  std::vector<std::size_t> taken;
  for (int k = 0; k < 30; ++k) {
    scene.scene.prepare({kEye + Eigen::Vector3d(0.05 * k, 0, 0)}, true);
    taken.push_back(scene.scene.local_scenes_taken());
    std::this_thread::sleep_for(pause);
  }
  return taken;
}

/// The next one is asked for after a quarter of the reach, and taken over after three eighths.
TEST(SharedScenery, OfPicturesIsTakenOverAtOnePlaceHoweverSoonItIsReady) {
  const auto taken = taken_on_the_way(std::chrono::milliseconds(0));
  EXPECT_EQ(taken_on_the_way(std::chrono::milliseconds(20)), taken);
  EXPECT_EQ(taken[12], 1u);
  EXPECT_EQ(taken[18], 2u);
  EXPECT_EQ(taken.back(), 2u);
}

/// Each scene finds what a scene without local scenes finds, whichever of them made the shared
/// ones.
TEST(SharedScenery, IsExactInManyThreadsAtOnce) {
  const auto placements = field();
  std::vector<std::future<bool>> threads;
  for (int thread = 0; thread < 4; ++thread) {
    threads.push_back(std::async(std::launch::async, [&placements, thread] {
      TestScene shares(SceneKind::kVisual, {}, 0, placements);
      TestScene exact(SceneKind::kVisual, instances_only(), 0, placements);
      for (int k = 0; k < 60; ++k) {
        const Eigen::Vector3d eye_W(3.0 + 0.2 * k + 0.05 * thread, 9.9, 0.3);
        if (ranges_from(shares, eye_W) != ranges_from(exact, eye_W)) return false;
      }
      return true;
    }));
  }
  for (auto& thread : threads) EXPECT_TRUE(thread.get());
}

}  // namespace
}  // namespace ardee::test
