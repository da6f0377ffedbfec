// SPDX-License-Identifier: MIT
#include "bench/raycast_field.h"

#include <algorithm>
#include <cmath>

#include "ardee_sim/core/rng.h"

namespace ardee::bench {
namespace {

constexpr double kRowSpacing_m = 0.76;
constexpr double kPlantsPerSquareMetre = 8.0;
constexpr int kVariants = 4;
constexpr int kLeaves = 12;
constexpr int kLeafSegments = 24;
constexpr int kStalkSides = 8;
constexpr int kStalkSegments = 5;
constexpr double kHeight_m = 1.9;

/// Adds a grid of (rows + 1) x (columns + 1) vertices as triangles.
void add_grid(SubMesh& mesh, int rows, int columns, const std::vector<Eigen::Vector3d>& vertices) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Eigen::Vector3d& vertex : vertices) mesh.vertices.push_back(vertex.cast<float>());
  const auto at = [&](int row, int column) {
    return base + static_cast<std::uint32_t>(row * (columns + 1) + column);
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      mesh.triangles.push_back({at(row, column), at(row, column + 1), at(row + 1, column + 1)});
      mesh.triangles.push_back({at(row, column), at(row + 1, column + 1), at(row + 1, column)});
    }
  }
}

void add_stalk(SubMesh& mesh) {
  std::vector<Eigen::Vector3d> vertices;
  for (int row = 0; row <= kStalkSegments; ++row) {
    const double share = static_cast<double>(row) / kStalkSegments;
    for (int side = 0; side <= kStalkSides; ++side) {
      const double angle = 2.0 * M_PI * (side % kStalkSides) / kStalkSides;
      const double radius = 0.012 * (1.0 - 0.6 * share);
      vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), kHeight_m * share);
    }
  }
  add_grid(mesh, kStalkSegments, kStalkSides, vertices);
}

void add_leaf(SubMesh& mesh, double base_m, double azimuth, double length_m, double lift) {
  const Eigen::Vector2d out(std::cos(azimuth), std::sin(azimuth));
  const Eigen::Vector2d across(-out.y(), out.x());
  std::vector<Eigen::Vector3d> vertices;
  for (int k = 0; k <= kLeafSegments; ++k) {
    const double s = static_cast<double>(k) / kLeafSegments;
    const double width = 0.045 * std::sin(M_PI * std::min(1.0, 0.15 + 0.85 * s)) + 0.001;
    const Eigen::Vector2d middle = out * (0.85 * length_m * s);
    const double height = base_m + length_m * (lift * s - 1.1 * s * s);
    for (int side = -1; side <= 1; ++side) {
      const Eigen::Vector2d point = middle + across * (width * side);
      vertices.emplace_back(point.x(), point.y(), height + 0.3 * width * std::abs(side));
    }
  }
  add_grid(mesh, kLeafSegments, 2, vertices);
}

}  // namespace

std::shared_ptr<const Model> make_plant(std::uint64_t seed) {
  Rng rng(mix_bits(seed + 1));
  SubMesh mesh;
  mesh.name = "plant";
  add_stalk(mesh);
  for (int leaf = 0; leaf < kLeaves; ++leaf) {
    const double azimuth = M_PI * leaf + 0.5 * rng.normal();
    add_leaf(mesh, 0.12 + 0.13 * leaf, azimuth, 0.55 + 0.25 * rng.uniform(),
             0.8 + 0.4 * rng.uniform());
  }
  mesh.material = 0;
  auto file = std::make_shared<MeshFile>();
  file->parts.push_back(std::move(mesh));
  file->materials.emplace_back();
  file->materials.back().two_sided = true;
  auto model = std::make_shared<Model>();
  model->name = "plant";
  Link link;
  link.name = "link";
  Visual visual;
  visual.name = "visual";
  visual.geometry = Mesh{file, "plant.dae", "", false, {1, 1, 1}};
  link.visuals.push_back(std::move(visual));
  Collision collision;
  collision.name = "collision";
  collision.X_LC.p.z() = 0.5 * kHeight_m;
  collision.geometry = Cylinder{0.012, kHeight_m};
  link.collisions.push_back(std::move(collision));
  model->links.push_back(std::move(link));
  return model;
}

double field_side_m(std::size_t count) {
  return std::sqrt(static_cast<double>(count) / kPlantsPerSquareMetre);
}

std::vector<Placement> make_field(std::size_t count) {
  std::vector<std::shared_ptr<const Model>> models;
  for (std::uint64_t k = 0; k < kVariants; ++k) models.push_back(make_plant(k));
  const double side = field_side_m(count);
  const auto rows = static_cast<std::size_t>(std::max(1.0, std::round(side / kRowSpacing_m)));
  const std::size_t per_row = (count + rows - 1) / rows;
  const double spacing = side / static_cast<double>(per_row);
  Rng rng(mix_bits(7));
  std::vector<Placement> placements;
  placements.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = (static_cast<double>(i % per_row) + 0.5) * spacing - 0.5 * side;
    const double y =
        (static_cast<double>(i / per_row) + 0.5 - 0.5 * static_cast<double>(rows)) * kRowSpacing_m;
    const auto variant = static_cast<std::size_t>(rng.uniform() * kVariants);
    Placement placement;
    placement.model = models[variant];
    placement.X_WM = Pose::from_xyz_rpy({x + 0.02 * rng.normal(), y + 0.02 * rng.normal(), 0.0},
                                        {0, 0, 2.0 * M_PI * rng.uniform()});
    placement.scale = 0.9 + 0.2 * rng.uniform();
    placement.label = 1;
    placements.push_back(std::move(placement));
  }
  return placements;
}

}  // namespace ardee::bench
