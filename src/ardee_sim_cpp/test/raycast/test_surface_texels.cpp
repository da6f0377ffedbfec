// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

#include "scenes.h"

namespace ardee::test {
using namespace raycast;
namespace {

/// Returns triangles of all shapes about the origin, some with a side of a few centimetres, others
/// of metres.
std::vector<Placement> shards() {
  Rng rng(mix_bits(3));
  const auto anywhere = [&rng](double size_m) -> Eigen::Vector3d {
    return Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal()) * size_m;
  };
  SubMesh part;
  part.name = "shards";
  for (std::uint32_t k = 0; k < 400; ++k) {
    const Eigen::Vector3d middle = anywhere(2.0);
    const double size_m = std::pow(10.0, -1.5 * rng.uniform());
    for (int corner = 0; corner < 3; ++corner) {
      part.vertices.push_back((middle + anywhere(size_m)).cast<float>());
    }
    part.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
  }
  const auto model = model_of(mesh_of({part}), {}, two_sided());
  return {placed(model, Pose::from_xyz_rpy({40, -30, 2}, {0.3, -0.2, 1.1}), 1.3)};
}

struct Glances {
  Glances(const RayScene& scene, const Eigen::Vector3d& eye_W, int count)
      : eye(eye_W), blocks(blocks_of(random_pattern(count, 11), 0.01f, 30.0f)) {
    scene.pictures().trace_primary(eye, blocks.data(), blocks.size());
  }

  /// Returns requests for all rays, with texels of `width_m`.
  std::vector<TexelRequest> requests(float width_m) const {
    std::vector<TexelRequest> all;
    for (std::uint32_t ray = 0; ray < blocks.size() * PrimaryRayPacket::kRays; ++ray) {
      const PrimaryRayPacket& block = blocks[ray / PrimaryRayPacket::kRays];
      const int i = static_cast<int>(ray % PrimaryRayPacket::kRays);
      const bool behind = block.normal_W(i).dot(block.direction_W(i)) > 0.0f;
      all.push_back({block.triangle[i], block.u[i], block.v[i],
                     block.met(i) ? block.range_m[i] : 0.0f, behind ? -width_m : width_m, ray});
    }
    return all;
  }
  Eigen::Vector3d direction_W(std::size_t ray) const {
    return blocks[ray / PrimaryRayPacket::kRays]
        .direction_W(static_cast<int>(ray % PrimaryRayPacket::kRays))
        .cast<double>();
  }

  const Eigen::Vector3d eye;
  std::vector<PrimaryRayPacket> blocks;
};

TEST(SurfaceTexels, LieWhereRaysHaveMetThem) {
  const Eigen::Vector3d eye_W(40.2, -30.1, 2.1);
  TestScene test(SceneKind::kVisual, {}, 0, shards());
  test.scene.prepare({eye_W}, true);
  const Glances glances(test.scene, eye_W, 8000);
  for (const float width_m : {0.001f, 0.01f, 0.07f}) {
    const std::vector<TexelRequest> requests = glances.requests(width_m);
    std::vector<SurfaceTexel> texels(requests.size());
    EXPECT_NE(test.scene.pictures().find_texels(eye_W, glances.blocks.data(), requests.data(),
                                                requests.size(), texels.data()),
              0u);
    int met = 0;
    for (std::size_t k = 0; k < requests.size(); ++k) {
      EXPECT_EQ(texels[k].none(), !(requests[k].range_m > 0.0f));
      if (texels[k].none()) continue;
      ++met;
      const double size_m = std::ldexp(1.0, texels[k].size);
      EXPECT_LE(size_m, width_m);
      EXPECT_GT(2.0 * size_m, width_m);
      SceneRay ray;
      SurfaceInteraction point;
      test.scene.pictures().trace_texels(eye_W, &texels[k], 1, &ray, &point);
      const Eigen::Vector3d way_W = glances.direction_W(k);
      const Eigen::Vector3d at_W = eye_W + static_cast<double>(requests[k].range_m) * way_W;
      const Eigen::Vector3d middle_W = ray.origin_W + point.range_m * ray.direction_W;
      // Both points lie in one row and one column.
      EXPECT_LT((middle_W - at_W).norm(), 1.5 * size_m + 1e-5);
      EXPECT_NEAR(point.normal_W.dot(middle_W - at_W), 0.0, 1e-5);
      EXPECT_LT(point.normal_W.dot(way_W), 1e-6);
      EXPECT_NEAR((ray.direction_W + point.normal_W).norm(), 0.0, 1e-9);
    }
    EXPECT_GT(met, 3000);
  }
}

TEST(SurfaceTexels, AreAsManyAsTheAreaHolds) {
  // A right triangle of one metre: its longest side of 1.414 m is cut into 46 parts, its height
  // into 23.
  SubMesh part;
  part.name = "right";
  part.vertices = {{3, 0, 0}, {3, 1, 0}, {3, 0, 1}};
  part.triangles = {{0, 1, 2}};
  const Eigen::Vector3d eye_W(0, 0.3, 0.3);
  TestScene test(SceneKind::kVisual, {}, 0, {placed(model_of(mesh_of({part}), {}, two_sided()))});
  test.scene.prepare({eye_W}, true);
  const Glances glances(test.scene, eye_W, 1600000);
  const std::vector<TexelRequest> requests = glances.requests(0.04f);  // texels of 1/32 m
  std::vector<SurfaceTexel> texels(requests.size());
  test.scene.pictures().find_texels(eye_W, glances.blocks.data(), requests.data(), requests.size(),
                                    texels.data());
  std::set<std::tuple<std::uint32_t, std::uint32_t>> seen;
  for (const SurfaceTexel& texel : texels) {
    if (texel.none()) continue;
    EXPECT_EQ(texel.columns, 46u);
    EXPECT_LT(texel.column, 46u);
    EXPECT_LT(texel.row, 23u);
    seen.emplace(texel.column, texel.row);
  }
  // Row r lies between two sides of 45 degrees: 46 texels less two for each row below.
  EXPECT_EQ(seen.size(), 552u);
}

TEST(SurfaceTexels, AreNoneWhereSomethingElseIsMet) {
  const Eigen::Vector3d eye_W(40.2, -30.1, 2.1);
  TestScene test(SceneKind::kVisual, {}, 0, shards());
  test.scene.add_model(5000, model_of(mesh_of({box_mesh("box", {0.5, 0.5, 0.5})})));
  test.scene.set_link_poses(5000, {{{40.7, -30.1, 2.1}, Eigen::Quaterniond::Identity()}});
  test.scene.prepare({eye_W}, true);
  const Glances glances(test.scene, eye_W, 3200);
  const std::vector<TexelRequest> requests = glances.requests(0.01f);
  std::vector<SurfaceTexel> texels(requests.size());
  test.scene.pictures().find_texels(eye_W, glances.blocks.data(), requests.data(), requests.size(),
                                    texels.data());
  int of_box = 0;
  for (std::size_t k = 0; k < requests.size(); ++k) {
    const bool outside = (requests[k].triangle & PrimaryRayPacket::kOutside) != 0;
    EXPECT_EQ(texels[k].none(), outside || !(requests[k].range_m > 0.0f));
    of_box += outside ? 1 : 0;
  }
  EXPECT_GT(of_box, 100);
  const Eigen::Vector3f up(0, 0, 1);
  EXPECT_TRUE(test.scene.pictures().may_be_shaded(eye_W, {40.7f, -30.1f, 0.0f}, up, 0.0f));
  EXPECT_FALSE(test.scene.pictures().may_be_shaded(eye_W, {40.7f, -30.1f, 4.0f}, up, 0.0f));
  EXPECT_FALSE(test.scene.pictures().may_be_shaded(eye_W, {41.7f, -30.1f, 0.0f}, up, 0.0f));
  EXPECT_TRUE(test.scene.pictures().may_be_shaded(eye_W, {41.7f, -30.1f, 0.0f}, up, 0.7f));
}

TEST(SurfaceTexels, AreNoneWithoutADraft) {
  const Eigen::Vector3d eye_W(40.2, -30.1, 2.1);
  TestScene test(SceneKind::kVisual, {}, 0, shards());
  test.scene.prepare({eye_W});
  const Glances glances(test.scene, eye_W, 320);
  const std::vector<TexelRequest> requests = glances.requests(0.01f);
  std::vector<SurfaceTexel> texels(requests.size());
  EXPECT_EQ(test.scene.pictures().find_texels(eye_W, glances.blocks.data(), requests.data(),
                                              requests.size(), texels.data()),
            0u);
  for (const SurfaceTexel& texel : texels) EXPECT_TRUE(texel.none());
}

}  // namespace
}  // namespace ardee::test
