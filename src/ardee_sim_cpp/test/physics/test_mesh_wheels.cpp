// SPDX-License-Identifier: MIT
// Tests of a robot on wheels that are meshes of 40,000 triangles each.
#include <gtest/gtest.h>

#include "rover.h"

namespace ardee::test {
using namespace physics;
namespace {

constexpr double kStep_s = 0.001;
constexpr int kAround = 200, kProfile = 100;  // corners

/// Returns a ring along z whose profile is a rounded rectangle, tread outwards.
std::shared_ptr<MeshFile> tyre(double radius_m, double width_m) {
  auto file = std::make_shared<MeshFile>();
  file->parts.emplace_back();
  SubMesh& part = file->parts[0];
  const auto rounded = [](double x) { return std::copysign(std::pow(std::abs(x), 0.25), x); };
  for (int i = 0; i < kAround; ++i) {
    const double angle = 2.0 * M_PI * i / kAround;
    for (int j = 0; j < kProfile; ++j) {
      const double turn = 2.0 * M_PI * j / kProfile;
      const double r = radius_m * (0.8 + 0.2 * rounded(std::cos(turn)));
      const double z = 0.5 * width_m * rounded(std::sin(turn));
      part.vertices.push_back(
          Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), z).cast<float>());
    }
  }
  const auto corner = [](int i, int j) {
    return static_cast<std::uint32_t>((i % kAround) * kProfile + j % kProfile);
  };
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kProfile; ++j) {
      part.triangles.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
      part.triangles.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
  }
  return file;
}

std::shared_ptr<Model> rover_on_meshes(const RoverShape& shape) {
  auto rover = rover_model(shape);
  Mesh mesh;
  mesh.uri = "tyre";
  mesh.file = tyre(shape.wheel_radius_m, shape.wheel_width_m);
  for (Link& link : rover->links) {
    for (Collision& each : link.collisions) {
      if (std::holds_alternative<Cylinder>(each.geometry)) each.geometry = mesh;
    }
  }
  return rover;
}

class MeshWheels : public ::testing::Test {
 protected:
  MeshWheels() : world_(params(kStep_s), silent()) { shape_.legs = false; }

  /// Returns the robot's distance as a share of an ideal wheel's, over the same second of a
  /// straight drive.
  double rolling() {
    PhysicsModel& rover =
        world_.add_model(rover_on_meshes(shape_), at(0, 0, shape_.wheel_radius_m + 0.002));
    const double rate = 5.0;
    const auto run = [&] {
      for (int i = 0; i < 1000; ++i) {
        drive(rover, shape_, rate, rate);
        EXPECT_TRUE(world_.step().empty());
      }
    };
    run();
    EXPECT_NEAR(rover.pose().p.z(), shape_.wheel_radius_m, 1.5e-3);
    const double start_m = rover.pose().p.x(), start_rad = rover.joint_position(0);
    run();
    EXPECT_GT(world_.stats().contacts, 3u);
    EXPECT_NEAR(rover.pose().p.y(), 0.0, 0.01);
    return (rover.pose().p.x() - start_m) /
           (shape_.wheel_radius_m * (rover.joint_position(0) - start_rad));
  }

  RoverShape shape_;
  PhysicsWorld world_;
};

TEST_F(MeshWheels, RollOnAPlane) {
  add_ground(world_);
  EXPECT_NEAR(rolling(), 1.0, 0.01);
}

TEST_F(MeshWheels, RollOnAHeightField) {
  Heightmap flat;
  flat.grid = height_grid(129, 12.9, [](double, double) { return 0.0; });
  world_.add_scenery({placement(static_model(flat))});
  EXPECT_NEAR(rolling(), 1.0, 0.01);
}

TEST_F(MeshWheels, RollOnABox) {
  world_.add_scenery({placement(static_model(Box{{10, 10, 1}}), at(0, 0, -0.5))});
  EXPECT_NEAR(rolling(), 1.0, 0.01);
}

}  // namespace
}  // namespace ardee::test
