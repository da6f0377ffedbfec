// SPDX-License-Identifier: MIT
// Tests of rays along axes and beside them, as from a device at rest: components that are zero,
// denormal or tiny, of either sign, in every octant and on the borders between octants.
#include <gtest/gtest.h>

#include "scenes.h"

namespace ardee::test {
using namespace raycast;
namespace {

constexpr double kHalfRoom_m = 3.0;
constexpr float kWall_m = 6.2f;
const Eigen::Vector3d kEye_W(0.1, -0.2, 0.3);

enum class Walls { kMesh, kBox, kHeights };

/// Returns a sheet of 8 x 8 squares at z = 0 that is visible from above.
SubMesh sheet() {
  constexpr int kSquares = 8;
  SubMesh part;
  part.name = "sheet";
  for (int k = 0; k < (kSquares + 1) * (kSquares + 1); ++k) {
    const auto column = static_cast<float>(k % (kSquares + 1));
    const auto row = static_cast<float>(k / (kSquares + 1));
    part.vertices.emplace_back(kWall_m * (column / kSquares - 0.5f),
                               kWall_m * (row / kSquares - 0.5f), 0.0f);
  }
  for (std::uint32_t k = 0; k < kSquares * kSquares; ++k) {
    const std::uint32_t a = k / kSquares * (kSquares + 1) + k % kSquares;
    const std::uint32_t c = a + kSquares + 1;
    part.triangles.push_back({a, a + 1, c + 1});
    part.triangles.push_back({a, c + 1, c});
  }
  return part;
}

std::shared_ptr<Model> wall(Walls kind) {
  switch (kind) {
    case Walls::kMesh:
      return model_of(mesh_of({sheet()}));
    case Walls::kBox:
      return model_of(Box{{kWall_m, kWall_m, 0.2}}, {{0, 0, -0.1}, Eigen::Quaterniond::Identity()});
    case Walls::kHeights:
      break;
  }
  auto grid = std::make_shared<HeightGrid>();
  grid->columns = grid->rows = 17;
  grid->size_m = {kWall_m, kWall_m};
  grid->heights_m.assign(17u * 17u, 0.0f);
  Heightmap map;
  map.grid = grid;
  return model_of(map);
}

/// Returns the poses of the six walls of a room about the origin, each facing the middle.
std::vector<Pose> places() {
  std::vector<Pose> poses;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector3d outwards = side * Eigen::Vector3d::Unit(axis);
      poses.push_back({kHalfRoom_m * outwards,
                       Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), -outwards)});
    }
  }
  return poses;
}

/// Returns the distance of the room's walls from the eye.
double range_m(const Eigen::Vector3d& direction) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0.0) continue;
    const double side = direction[k] > 0.0 ? kHalfRoom_m : -kHalfRoom_m;
    nearest = std::min(nearest, (side - kEye_W[k]) / direction[k]);
  }
  return nearest;
}

/// Returns zero and sizes down to the least denormal, of either sign.
std::vector<double> tiny_components() {
  std::vector<double> result;
  for (const double size :
       {0.0, 5e-324, 1e-310, 1e-40, 1e-19, 9.9e-19, 1.1e-18, 9e-18, 1.1e-17, 1e-7}) {
    result.push_back(size);
    result.push_back(-size);
  }
  return result;
}

/// Appends a block of sixteen rays about an octant or a border between octants: every fifth ray has
/// `tiny` along the axes whose sign is 0, and its neighbours are on one side of it.
void add_block(const Eigen::Vector3i& sign, const Eigen::Vector3d& tiny, double side,
               std::vector<Eigen::Vector3d>& directions) {
  for (int k = 0; k < PrimaryRayPacket::kRays; ++k) {
    Eigen::Vector3d direction;
    for (int axis = 0; axis < 3; ++axis) {
      const double beside = k % 5 == 0 ? tiny[axis] : side * 0.01 * k;
      direction[axis] = sign[axis] == 0 ? beside : sign[axis] * (1.0 + 0.1 * axis);
    }
    directions.push_back(direction.normalized());
  }
}

std::vector<Eigen::Vector3d> directions() {
  const std::vector<double> tiny = tiny_components();
  std::vector<Eigen::Vector3d> result;
  for (int octant = 0; octant < 27; ++octant) {
    const Eigen::Vector3i sign(octant % 3 - 1, octant / 3 % 3 - 1, octant / 9 - 1);
    if (sign.isZero()) continue;
    const bool is_axis = sign.cwiseAbs().sum() == 1;
    for (const double first : tiny) {
      for (const double second : is_axis ? tiny : std::vector<double>{first}) {
        const Eigen::Vector3d each(first, sign.x() == 0 ? second : first, second);
        for (const double side : {-1.0, 1.0}) add_block(sign, each, side, result);
      }
    }
  }
  return result;
}

class Directions : public ::testing::TestWithParam<std::tuple<Walls, bool>> {
 protected:
  Directions() : room_(SceneKind::kVisual, options(), 0, placements()) {
    for (const Eigen::Vector3d& direction : directions()) {
      rays_.push_back({kEye_W, direction, std::numeric_limits<double>::infinity()});
    }
    room_.scene.prepare({kEye_W}, true);
  }

  static RayOptions options() {
    return std::get<bool>(GetParam()) ? RayOptions{} : instances_only();
  }
  static std::vector<Placement> placements() {
    std::vector<Placement> result;
    const auto model = wall(std::get<Walls>(GetParam()));
    for (const Pose& pose : places()) result.push_back(placed(model, pose));
    return result;
  }

  void expect_room(const std::vector<RayHit>& hits) const {
    ASSERT_EQ(hits.size(), rays_.size());
    for (std::size_t k = 0; k < hits.size(); ++k) expect_range(k, hits[k].range_m);
  }
  void expect_range(std::size_t k, double range) const {
    const Eigen::Vector3d& direction = rays_[k].direction_W;
    const double expected = range_m(direction);
    ASSERT_NEAR(range, expected, 1e-5 * expected) << "towards " << direction.transpose();
  }

  TestScene room_;
  std::vector<SceneRay> rays_;
};
INSTANTIATE_TEST_SUITE_P(Rays, Directions,
                         ::testing::Combine(::testing::Values(Walls::kMesh, Walls::kBox,
                                                              Walls::kHeights),
                                            ::testing::Bool()));

TEST_P(Directions, OfScansMeetTheWall) {
  std::vector<RayHit> hits;
  room_.scene.cast(rays_, kNoEntity, 0, hits);
  expect_room(hits);
  RayPattern pattern;
  for (const SceneRay& ray : rays_) pattern.directions_S.push_back(ray.direction_W.cast<float>());
  expect_room(room_.cast({kEye_W, Eigen::Quaterniond::Identity()}, pattern, kInfinity));
}

TEST_P(Directions, OfPicturesMeetTheWall) {
  std::vector<SurfaceInteraction> points(rays_.size());
  room_.scene.pictures().trace(rays_.data(), rays_.size(), points.data());
  for (std::size_t k = 0; k < rays_.size(); ++k) expect_range(k, points[k].range_m);
  room_.scene.pictures().trace_approximately(rays_.data(), rays_.size(), points.data());
  for (std::size_t k = 0; k < rays_.size(); ++k) expect_range(k, points[k].range_m);
  RayPattern pattern;
  for (const SceneRay& ray : rays_) pattern.directions_S.push_back(ray.direction_W.cast<float>());
  std::vector<PrimaryRayPacket> blocks = blocks_of(pattern, 0.0f, 100.0f);
  room_.scene.pictures().trace_primary(kEye_W, blocks.data(), blocks.size());
  for (std::size_t k = 0; k < rays_.size(); ++k) {
    const PrimaryRayPacket& block = blocks[k / PrimaryRayPacket::kRays];
    expect_range(k, static_cast<double>(block.range_m[k % PrimaryRayPacket::kRays]));
  }
}

TEST_P(Directions, OfShadowsEndAtTheWall) {
  const auto shadows = std::make_unique<bool[]>(rays_.size());
  for (const bool reaches : {false, true}) {
    for (SceneRay& ray : rays_) {
      ray.reach_m = (reaches ? 1.001 : 0.999) * range_m(ray.direction_W);
    }
    for (const bool quickly : {false, true}) {
      if (quickly) {
        room_.scene.pictures().find_shadows_approximately(rays_.data(), rays_.size(),
                                                          shadows.get());
      } else {
        room_.scene.pictures().find_shadows(rays_.data(), rays_.size(), shadows.get());
      }
      for (std::size_t k = 0; k < rays_.size(); ++k) {
        ASSERT_EQ(shadows[k], reaches) << "towards " << rays_[k].direction_W.transpose();
      }
    }
  }
}

TEST_P(Directions, MeetWallsThatMove) {
  auto walls = std::make_shared<Model>();
  for (std::size_t k = 0; k < places().size(); ++k) {
    walls->links.push_back(wall(std::get<Walls>(GetParam()))->links[0]);
  }
  TestScene moving(SceneKind::kVisual, options());
  moving.scene.add_model(7, walls);
  moving.scene.set_link_poses(7, places());
  moving.scene.prepare({kEye_W});
  std::vector<RayHit> hits;
  moving.scene.cast(rays_, kNoEntity, 0, hits);
  expect_room(hits);
  moving.scene.cast_at_model(rays_, 7, kAllLinks - 1, hits);
  expect_room(hits);
}

/// The eye is above all bodies, and looks up or past them without limit.
TEST(InfiniteReach, MeetsNothingBeyondTheScenery) {
  for (const RayOptions& options : {RayOptions{}, instances_only()}) {
    TestScene test(SceneKind::kVisual, options, 0,
                   {placed(wall(Walls::kMesh)), placed(wall(Walls::kHeights))});
    for (const double height_m : {0.5, 50.0, 5e4}) {
      for (const double tiny : {0.0, -0.0, 1e-310, -1e-310, 1e-19, -1e-19}) {
        const Eigen::Vector3d eye(0.1, -0.2, height_m);
        const auto one = [&](const Eigen::Vector3d& direction) {
          return test.one(eye, direction, kInfinity).range_m;
        };
        EXPECT_EQ(one({tiny, tiny, 1}), kInfinity);
        EXPECT_EQ(one({1, tiny, tiny}), kInfinity);
        EXPECT_FLOAT_EQ(one({tiny, tiny, -1}), static_cast<float>(height_m));
      }
    }
  }
}

}  // namespace
}  // namespace ardee::test
