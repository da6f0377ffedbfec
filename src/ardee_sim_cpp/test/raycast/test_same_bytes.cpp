// SPDX-License-Identifier: MIT
// Tests that hits do not depend on threads, on local scenes or on their timing.
#include <gtest/gtest.h>

#include <cstring>

#include "scenes.h"

namespace ardee::test {
using namespace raycast;
namespace {

/// Returns a crumpled sheet of triangles with shared edges, which overlaps its neighbours
/// everywhere if placed densely.
std::shared_ptr<Model> crumpled(std::uint64_t seed, bool both_sides) {
  Rng rng(mix_bits(seed));
  SubMesh part;
  part.name = "sheet";
  const int n = 12;
  for (int k = 0; k < (n + 1) * (n + 1); ++k) {
    const double u = 1.2 * (k % (n + 1)) / n - 0.6;
    const double v = 1.2 * static_cast<double>(k / (n + 1)) / n;
    part.vertices.emplace_back(static_cast<float>(u + 0.05 * rng.normal()),
                               static_cast<float>(0.1 * rng.normal()),
                               static_cast<float>(v + 0.05 * rng.normal()));
  }
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      const auto a = static_cast<std::uint32_t>(row * (n + 1) + column);
      const std::uint32_t b = a + 1, c = a + n + 1, d = a + n + 2;
      part.triangles.push_back({a, b, d});
      part.triangles.push_back({a, d, c});
    }
  }
  auto model = model_of(mesh_of({part}), {}, both_sides ? two_sided() : Material{});
  Visual stem = model->links[0].visuals[0];
  stem.geometry = Cylinder{0.02, 1.5};
  stem.X_LV.p.z() = 0.75;
  model->links[0].visuals.push_back(stem);
  return model;
}

/// Returns plants on a jittered grid, every tenth one twice at the same place (ties), on a ground.
std::vector<Placement> field(int side, double spacing, const Eigen::Vector3d& corner) {
  const std::vector<std::shared_ptr<Model>> models = {crumpled(1, true), crumpled(2, false),
                                                      crumpled(3, true)};
  Rng rng(mix_bits(77));
  std::vector<Placement> placements;
  for (int k = 0; k < side * side; ++k) {
    const Eigen::Vector3d p =
        corner + Eigen::Vector3d(spacing * (k % side) + 0.1 * rng.normal(),
                                 spacing * (k / side) + 0.1 * rng.normal(), 0);
    const Pose pose =
        Pose::from_xyz_rpy(p, {0.1 * rng.normal(), 0.1 * rng.normal(), 6.3 * rng.uniform()});
    const auto& model = models[static_cast<std::size_t>(k % 3)];
    placements.push_back(placed(model, pose, 0.8 + 0.4 * rng.uniform(), 1));
    if (k % 10 == 0) placements.push_back(placements.back());
  }
  auto grid = std::make_shared<HeightGrid>();
  grid->columns = grid->rows = 33;
  grid->size_m = {40, 40};
  for (int k = 0; k < 33 * 33; ++k)
    grid->heights_m.push_back(static_cast<float>(0.1 * rng.uniform()));
  Heightmap map;
  map.grid = grid;
  placements.push_back(placed(model_of(map), {corner + Eigen::Vector3d(8, 8, 0), {1, 0, 0, 0}}));
  return placements;
}

bool same(const std::vector<RayHit>& a, const std::vector<RayHit>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(RayHit)) == 0;
}

RayOptions options(bool flatten, double radius_m, int threads, std::size_t budget = 512u << 20) {
  RayOptions result;
  result.local_scenes = flatten;
  result.local_scene_radius_m = radius_m;
  result.threads = threads;
  result.local_scene_budget_bytes = budget;
  return result;
}

class SameBytes : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(NearAndFarFromTheOrigin, SameBytes, ::testing::Values(0.0, 800.0));

TEST_P(SameBytes, ForAnyThreadsAndAnyRegions) {
  const Eigen::Vector3d corner(GetParam(), -0.7 * GetParam(), 0.02 * GetParam());
  const auto placements = field(40, 0.4, corner);
  std::vector<std::unique_ptr<TestScene>> scenes;
  for (const RayOptions& each : {options(false, 6, 1), options(false, 6, 2), options(false, 6, 8),
                                 options(true, 1, 1), options(true, 3, 8), options(true, 50, 1),
                                 options(true, 50, 2), options(true, 6, 2, 400000)}) {
    scenes.push_back(std::make_unique<TestScene>(SceneKind::kVisual, each));
    scenes.back()->scene.add_scenery(1000, placements);
    scenes.back()->scene.add_model(3, crumpled(9, true));
  }
  Rng rng(mix_bits(42));
  int finite = 0;
  for (int scan = 0; scan < 24; ++scan) {
    const Pose eye =
        Pose::from_xyz_rpy(corner + Eigen::Vector3d(16 * rng.uniform(), 16 * rng.uniform(),
                                                    scan % 6 == 5 ? 40.0 : 0.5),
                           {rng.normal(), rng.normal(), 6.3 * rng.uniform()});
    const Pose other =
        Pose::from_xyz_rpy(corner + Eigen::Vector3d(16 * rng.uniform(), 8, 0.3), {0.2, 0, 1});
    const RayPattern pattern =
        scan % 2 == 0 ? random_pattern(6000, static_cast<std::uint64_t>(scan)) : fan(6000, -3, 3);
    std::vector<RayHit> first;
    for (const auto& scene : scenes) {
      scene->scene.set_link_poses(3, {other});
      const auto hits = scene->cast(eye, pattern, 60.0f);
      if (first.empty()) first = hits;
      ASSERT_TRUE(same(first, hits)) << "scan " << scan << ", scene " << (&scene - scenes.data());
    }
    for (const RayHit& hit : first) finite += std::isfinite(hit.range_m) ? 1 : 0;
  }
  EXPECT_GT(finite, 50000);
}

TEST(SameBytes, WhileRegionsFollowADrivingSensor) {
  const auto placements = field(40, 0.4, {0, 0, 0});
  TestScene still(SceneKind::kVisual, options(false, 0, 1));
  TestScene near(SceneKind::kVisual, options(true, 2.0, 2));
  still.scene.add_scenery(0, placements);
  near.scene.add_scenery(0, placements);
  const RayPattern pattern = fan(541, -2.3, 2.3);
  for (int k = 0; k < 300; ++k) {
    const Pose eye = Pose::from_xyz_rpy({0.05 * k, 8.0, 0.25}, {0.01, 0.02, 0.002 * k});
    ASSERT_TRUE(same(still.cast(eye, pattern), near.cast(eye, pattern))) << k;
  }
}

/// The eye goes far from the first local scene's centre, then up and down within a metre: one more
/// local scene is enough.
TEST(Regions, AreNotMadeAgainWhereOneIsNear) {
  TestScene test(SceneKind::kVisual, options(true, 4.0, 1));
  test.scene.add_scenery(0, field(40, 0.4, {0, 0, 0}));
  constexpr bool kAtOnce = true;  // for pictures, a due local scene is waited for
  test.scene.prepare({{2.0, 8.0, 0.3}}, kAtOnce);
  const std::size_t before = test.scene.local_scenes_taken();
  for (int k = 0; k < 200; ++k) {
    test.scene.prepare({{9.5 - 0.02 * std::abs(k % 100 - 50), 8.0, 0.3}}, kAtOnce);
  }
  EXPECT_GT(test.scene.local_scenes_taken(), before);
  EXPECT_LE(test.scene.local_scenes_taken(), before + 2);
}

TEST(SameBytes, AgainAfterRemovalAndReturn) {
  const auto placements = field(20, 0.4, {0, 0, 0});
  TestScene scene(SceneKind::kVisual);
  scene.scene.add_scenery(0, placements);
  const Pose eye = Pose::from_xyz_rpy({4, 4, 0.5}, {0, 0, 0});
  const RayPattern pattern = random_pattern(5000, 1);
  const auto before = scene.cast(eye, pattern);
  scene.scene.remove_scenery(0);
  for (const RayHit& hit : scene.cast(eye, pattern)) ASSERT_EQ(hit.range_m, kInfinity);
  scene.scene.add_scenery(0, placements);
  EXPECT_TRUE(same(before, scene.cast(eye, pattern)));
}

/// Returns the nearest of all triangles of the visual meshes, by brute force in long double.
double nearest(const std::vector<Placement>& placements, const Eigen::Vector3d& o,
               const Eigen::Vector3d& d) {
  using V = Eigen::Matrix<long double, 3, 1>;
  long double best = std::numeric_limits<long double>::infinity();
  for (const Placement& placement : placements) {
    const auto& shape = placement.model->links[0].visuals[0];
    if (!std::holds_alternative<Mesh>(shape.geometry)) continue;
    const SubMesh& part = std::get<Mesh>(shape.geometry).file->parts[0];
    const V lo = (placement.X_WM.inverse() * o / placement.scale).cast<long double>();
    const V ld = (placement.X_WM.q.conjugate() * d / placement.scale).cast<long double>();
    for (const auto& corners : part.triangles) {
      const V a = part.vertices[corners[0]].cast<long double>();
      const V e1 = part.vertices[corners[1]].cast<long double>() - a;
      const V e2 = part.vertices[corners[2]].cast<long double>() - a;
      const V n = e1.cross(e2);
      const long double slope = n.dot(ld);
      if (slope == 0 || (slope > 0 && !shape.material->two_sided)) continue;
      const V c = a - lo;
      const V r = c.cross(ld);
      const long double u = r.dot(e2) / slope, v = -r.dot(e1) / slope, t = n.dot(c) / slope;
      if (u >= 0 && v >= 0 && u + v <= 1 && t >= 0) best = std::min(best, t);
    }
  }
  return static_cast<double>(best);
}

TEST(Truth, NearestOfAllTrianglesByBruteForce) {
  for (const double offset : {0.0, 900.0}) {
    auto placements = field(6, 0.5, {offset, offset, 0});
    placements.pop_back();
    for (Placement& placement : placements) {
      auto bare = std::make_shared<Model>(*placement.model);
      bare->links[0].visuals.resize(1);
      placement.model = bare;
    }
    for (const bool flatten : {true, false}) {
      TestScene scene(SceneKind::kVisual, options(flatten, 6, 1));
      scene.scene.add_scenery(0, placements);
      const Pose eye = Pose::from_xyz_rpy({offset + 1.3, offset + 1.4, 0.5}, {0, 0, 0});
      const RayPattern pattern = random_pattern(600, 8);
      const auto hits = scene.cast(eye, pattern);
      for (std::size_t k = 0; k < hits.size(); ++k) {
        const Eigen::Vector3d d = pattern.directions_S[k].cast<double>().normalized();
        const double expected = nearest(placements, eye.p, d);
        if (std::isinf(expected)) {
          EXPECT_EQ(hits[k].range_m, kInfinity);
        } else {
          EXPECT_NEAR(hits[k].range_m, expected, 1e-6 + 1e-7 * expected);
        }
      }
    }
  }
}

TEST(Truth, FarFromTheOriginAsExactAsNear) {
  for (const Eigen::Vector3d& corner :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1024, -2048, 16)}) {
    for (const bool flatten : {true, false}) {
      TestScene scene(SceneKind::kVisual, options(flatten, 6, 1));
      const Pose pose{corner + Eigen::Vector3d(3, 0, 0), Eigen::Quaterniond::Identity()};
      scene.scene.add_scenery(0, {placed(model_of(mesh_of({box_mesh("box", {1, 1, 1})})), pose),
                                  placed(model_of(Cylinder{0.01, 1}),
                                         {corner + Eigen::Vector3d(0, 2, 0), {1, 0, 0, 0}})});
      EXPECT_FLOAT_EQ(scene.one(corner, {1, 0, 0}).range_m, 2.5f);
      EXPECT_FLOAT_EQ(scene.one(corner, {0, 1, 0}).range_m, 1.99f);
      // The edge's place is exact to a micrometre.
      const Eigen::Vector3d up(0, 0, 1);
      EXPECT_TRUE(std::isfinite(scene.one(corner + 0.499999 * up, {1, 0, 0}).range_m));
      EXPECT_EQ(scene.one(corner + 0.500001 * up, {1, 0, 0}).range_m, kInfinity);
    }
  }
}

TEST(Truth, TwoScenesInOneProcess) {
  TestScene a(SceneKind::kVisual), b(SceneKind::kVisual);
  a.scene.add_scenery(0, {placed(model_of(Sphere{1}), {{5, 0, 0}, {1, 0, 0, 0}})});
  b.scene.add_scenery(0, {placed(model_of(Sphere{1}), {{9, 0, 0}, {1, 0, 0, 0}})});
  EXPECT_FLOAT_EQ(a.one({0, 0, 0}, {1, 0, 0}).range_m, 4.0f);
  EXPECT_FLOAT_EQ(b.one({0, 0, 0}, {1, 0, 0}).range_m, 8.0f);
}

TEST(QuickLooks, MeetWhatExactOnesMeet) {
  TestScene test(SceneKind::kVisual, options(true, 4.0, 1), 0, field(18, 0.8, {100, 50, 0}));
  const Eigen::Vector3d eye_W(107, 57, 0.7);
  test.scene.prepare({eye_W}, true);
  std::vector<SceneRay> rays, shadow_rays;
  for (const Eigen::Vector3f& direction : random_pattern(4000, 5).directions_S) {
    rays.push_back({eye_W, direction.cast<double>().normalized(), 30.0});
  }
  std::vector<SurfaceInteraction> exact(rays.size()), quick(rays.size());
  test.scene.pictures().trace(rays.data(), rays.size(), exact.data());
  test.scene.pictures().trace_approximately(rays.data(), rays.size(), quick.data());
  const Eigen::Vector3d sun = Eigen::Vector3d(0.3, -0.4, 1.0).normalized();
  int same_points = 0, hits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool met = exact[i].met();
    const bool same =
        met == quick[i].met() && (!met || (std::abs(exact[i].range_m - quick[i].range_m) < 1e-5 &&
                                           (exact[i].normal_W - quick[i].normal_W).norm() < 1e-3));
    same_points += same ? 1 : 0;
    if (!met) continue;
    ++hits;
    const Eigen::Vector3d at = eye_W + exact[i].range_m * rays[i].direction_W;
    shadow_rays.push_back({at + 1e-4 * exact[i].normal_W, sun, 30.0});
  }
  EXPECT_GT(hits, 2000);
  EXPECT_GE(same_points, 3996);  // floats may decide between two things micrometres apart
  const auto exact_shadows = std::make_unique<bool[]>(shadow_rays.size());
  const auto quick_shadows = std::make_unique<bool[]>(shadow_rays.size());
  test.scene.pictures().find_shadows(shadow_rays.data(), shadow_rays.size(), exact_shadows.get());
  test.scene.pictures().find_shadows_approximately(shadow_rays.data(), shadow_rays.size(),
                                                   quick_shadows.get());
  int same_shadows = 0, dark = 0;
  for (std::size_t i = 0; i < shadow_rays.size(); ++i) {
    same_shadows += exact_shadows[i] == quick_shadows[i] ? 1 : 0;
    dark += exact_shadows[i] ? 1 : 0;
  }
  EXPECT_GT(dark, 200);
  EXPECT_GE(same_shadows, static_cast<int>(shadow_rays.size()) - 4);
}

TEST(QuickLooks, GlancesAndLooksThatFollowAgreeWithWholeOnes) {
  const auto box = model_of(mesh_of({box_mesh("box", {0.5, 0.5, 0.5})}));
  for (const bool pictures : {true, false}) {  // with a triangle scene, and without
    TestScene test(SceneKind::kVisual, options(true, 4.0, 1), 0, field(18, 0.8, {100, 50, 0}));
    const Eigen::Vector3d eye_W(107, 57, 0.7);
    test.scene.add_model(5000, box);
    test.scene.set_link_poses(5000, {{{107.5, 57, 0.7}, Eigen::Quaterniond::Identity()}});
    test.scene.prepare({eye_W}, pictures);
    std::vector<PrimaryRayPacket> blocks = blocks_of(random_pattern(3200, 5), 0.2f, 30.0f);
    std::vector<SceneRay> whole;
    for (const PrimaryRayPacket& block : blocks) {
      for (int i = 0; i < PrimaryRayPacket::kRays; ++i) {
        const Eigen::Vector3d way_W = block.direction_W(i).cast<double>();
        whole.push_back({eye_W + 0.2 * way_W, way_W, 29.8});
      }
    }
    test.scene.pictures().trace_primary(eye_W, blocks.data(), blocks.size());
    std::vector<SurfaceInteraction> looks(whole.size());
    test.scene.pictures().trace_approximately(whole.data(), whole.size(), looks.data());
    std::vector<SceneRay> rays;  // those that both trace_primary() and a whole look let hit
    std::vector<std::uint32_t> triangles;
    std::vector<std::size_t> places;
    int same_points = 0, of_model = 0, outside = 0;
    for (std::size_t k = 0; k < whole.size(); ++k) {
      const PrimaryRayPacket& block = blocks[k / PrimaryRayPacket::kRays];
      const int i = static_cast<int>(k % PrimaryRayPacket::kRays);
      if (!looks[k].met() || !block.met(i)) {
        same_points += looks[k].met() == block.met(i) ? 1 : 0;
        continue;
      }
      rays.push_back(whole[k]);
      triangles.push_back(block.triangle[i]);
      places.push_back(k);
      outside += (block.triangle[i] & PrimaryRayPacket::kOutside) != 0 ? 1 : 0;
    }
    std::vector<SurfaceInteraction> all(rays.size());
    test.scene.pictures().interpolate_hits(eye_W, rays.data(), triangles.data(), rays.size(),
                                           all.data());
    for (std::size_t n = 0; n < places.size(); ++n) {
      const std::size_t k = places[n];
      const PrimaryRayPacket& block = blocks[k / PrimaryRayPacket::kRays];
      const int i = static_cast<int>(k % PrimaryRayPacket::kRays);
      const SurfaceInteraction& closer = all[n];
      const double normals = block.normal_W(i).cast<double>().dot(looks[k].normal_W);
      const bool same =
          std::abs(looks[k].range_m - closer.range_m) < 1e-4 &&
          std::abs(looks[k].range_m + 0.2 - static_cast<double>(block.range_m[i])) < 1e-4 &&
          std::abs(std::abs(normals) - 1.0) < 1e-4;
      same_points += same ? 1 : 0;
      of_model += closer.entity == 5000 ? 1 : 0;
    }
    EXPECT_GE(same_points, 3196);
    EXPECT_GT(of_model, 50);
    EXPECT_GT(outside, 50);
    EXPECT_EQ(outside < static_cast<int>(rays.size()), pictures);
  }
}

/// The wall has no gap; its two triangles share an edge along rays of equal slope to the side and
/// upwards.
TEST(QuickLooks, DoNotSlipBetweenTriangles) {
  const auto wall = model_of(mesh_of({box_mesh("wall", {1.0f, 20.0f, 20.0f})}));
  TestScene test(SceneKind::kVisual, {}, 0,
                 {placed(wall, {{3.5, 0, 0}, Eigen::Quaterniond::Identity()})});
  test.scene.prepare({Eigen::Vector3d::Zero()}, true);
  RayPattern diagonals;
  for (int k = 0; k < 1024; ++k) {
    const float slope = (static_cast<float>(k) + 0.5f) / 1024.0f;
    for (const float sign : {-1.0f, 1.0f}) {
      diagonals.directions_S.emplace_back(Eigen::Vector3f(1, slope, sign * slope).normalized());
    }
  }
  std::vector<PrimaryRayPacket> blocks = blocks_of(diagonals, 0.05f, 30.0f);
  test.scene.pictures().trace_primary(Eigen::Vector3d::Zero(), blocks.data(), blocks.size());
  for (const PrimaryRayPacket& block : blocks) {
    for (int i = 0; i < PrimaryRayPacket::kRays; ++i) {
      EXPECT_NEAR(block.range_m[i], 3.0f / block.x_W[i], 1e-5f);
    }
  }
}

}  // namespace
}  // namespace ardee::test
