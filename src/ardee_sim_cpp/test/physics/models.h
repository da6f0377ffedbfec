// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "ardee_sim/physics/physics_world.h"

namespace ardee::test {
using namespace physics;

constexpr double kGravity = 9.8;

inline Log silent() {
  return Log([](LogLevel, const std::string&) {});
}

inline PhysicsParams params(double step_s) {
  PhysicsParams result;
  result.step_s = step_s;
  return result;
}

inline Inertial box_inertial(double mass_kg, const Eigen::Vector3d& size_m) {
  Inertial inertial;
  inertial.mass_kg = mass_kg;
  const Eigen::Vector3d s = size_m.cwiseAbs2();
  inertial.inertia_kg_m2.diagonal() =
      mass_kg / 12.0 * Eigen::Vector3d(s.y() + s.z(), s.x() + s.z(), s.x() + s.y());
  return inertial;
}

inline Link link(const std::string& name, const Inertial& inertial) {
  Link result;
  result.name = name;
  result.inertial = inertial;
  return result;
}

inline Collision collision(const Geometry& geometry, const Surface& surface = {}) {
  Collision result;
  result.name = "collision";
  result.geometry = geometry;
  result.surface = surface;
  return result;
}

inline std::shared_ptr<Model> model(const Link& only) {
  auto result = std::make_shared<Model>();
  result->name = "model";
  result->links.push_back(only);
  result->canonical_link = only.name;
  return result;
}

inline std::shared_ptr<Model> box_model(double mass_kg, const Eigen::Vector3d& size_m,
                                        const Surface& surface = {}) {
  Link body = link("box", box_inertial(mass_kg, size_m));
  body.collisions.push_back(collision(Box{size_m}, surface));
  return model(body);
}

inline std::shared_ptr<Model> sphere_model(double mass_kg, double radius_m,
                                           const Surface& surface = {}) {
  Inertial inertial;
  inertial.mass_kg = mass_kg;
  inertial.inertia_kg_m2 = 0.4 * mass_kg * radius_m * radius_m * Eigen::Matrix3d::Identity();
  Link body = link("ball", inertial);
  body.collisions.push_back(collision(Sphere{radius_m}, surface));
  return model(body);
}

/// Returns a static model of one shape.
inline std::shared_ptr<Model> static_model(const Geometry& geometry, const Surface& surface = {}) {
  Link body;
  body.name = "static";
  body.collisions.push_back(collision(geometry, surface));
  auto result = model(body);
  result->is_static = true;
  return result;
}

inline Placement placement(const std::shared_ptr<const Model>& what, const Pose& X_WM = {},
                           double scale = 1.0) {
  return {what, X_WM, scale, 0};
}

inline Pose at(double x, double y, double z) { return {{x, y, z}, Eigen::Quaterniond::Identity()}; }

inline void add_ground(PhysicsWorld& world, const Surface& surface = {}) {
  world.add_scenery({placement(static_model(Plane{}, surface))});
}

/// Returns a grid of heights h(x, y).
inline std::shared_ptr<const HeightGrid> height_grid(
    int points, double size_m, const std::function<double(double, double)>& height) {
  auto grid = std::make_shared<HeightGrid>();
  grid->columns = grid->rows = points;
  grid->size_m = {size_m, size_m};
  for (int row = 0; row < points; ++row) {
    for (int column = 0; column < points; ++column) {
      const double x = size_m * (static_cast<double>(column) / (points - 1) - 0.5);
      const double y = size_m * (static_cast<double>(row) / (points - 1) - 0.5);
      grid->heights_m.push_back(static_cast<float>(height(x, y)));
    }
  }
  return grid;
}

inline Geometry heightmap(const std::shared_ptr<const HeightGrid>& grid) {
  Heightmap result;
  result.grid = grid;
  return result;
}

/// Returns a square of `size_m` in the plane z = 0, in n x n cells of two triangles each.
inline Geometry mesh_square(unsigned n, double size_m) {
  auto file = std::make_shared<MeshFile>();
  SubMesh part;
  part.name = "square";
  for (unsigned j = 0; j <= n; ++j) {
    for (unsigned i = 0; i <= n; ++i) {
      part.vertices.push_back(
          (size_m * Eigen::Vector3d(i - 0.5 * n, j - 0.5 * n, 0) / n).cast<float>());
    }
  }
  for (unsigned j = 0; j < n; ++j) {
    for (unsigned i = 0; i < n; ++i) {
      const unsigned a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      part.triangles.push_back({a, b, d});
      part.triangles.push_back({a, d, c});
    }
  }
  file->parts.push_back(part);
  Mesh mesh;
  mesh.file = file;
  mesh.submesh = "square";
  return mesh;
}

inline int steps(const PhysicsWorld& world, double duration_s) {
  return static_cast<int>(std::lround(duration_s / world.params().step_s));
}

inline void run(PhysicsWorld& world, double duration_s) {
  const int count = steps(world, duration_s);
  for (int i = 0; i < count; ++i) world.step();
}

}  // namespace ardee::test
