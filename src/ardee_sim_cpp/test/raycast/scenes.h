// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/core/rng.h"
#include "ardee_sim/raycast/ray_scene.h"

namespace ardee::test {
using namespace raycast;

constexpr double kPi = 3.14159265358979323846;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Returns a model of one link with `geometry` as its visual and its collision.
inline std::shared_ptr<Model> model_of(const Geometry& geometry, const Pose& X_LS = {},
                                       std::optional<Material> material = std::nullopt) {
  auto model = std::make_shared<Model>();
  model->name = "test_model";
  Link link;
  link.name = "link";
  Visual visual;
  visual.name = "visual";
  visual.X_LV = X_LS;
  visual.geometry = geometry;
  visual.material = std::move(material);
  visual.laser_retro = 3.0;
  link.visuals.push_back(visual);
  Collision collision;
  collision.name = "collision";
  collision.X_LC = X_LS;
  collision.geometry = geometry;
  collision.laser_retro = 5.0;
  link.collisions.push_back(collision);
  model->links.push_back(link);
  return model;
}

inline Material two_sided() {
  Material material;
  material.two_sided = true;
  return material;
}

inline Placement placed(std::shared_ptr<const Model> model, const Pose& X_WM = {},
                        double scale = 1.0, std::uint32_t label = 0) {
  return {std::move(model), X_WM, scale, label};
}

/// Returns a closed box of twelve outward triangles as a mesh part.
inline SubMesh box_mesh(const std::string& name, const Eigen::Vector3f& size,
                        const Eigen::Vector3f& center = Eigen::Vector3f::Zero()) {
  SubMesh part;
  part.name = name;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3f sign((k & 1) != 0 ? 0.5f : -0.5f, (k & 2) != 0 ? 0.5f : -0.5f,
                               (k & 4) != 0 ? 0.5f : -0.5f);
    part.vertices.push_back(center + sign.cwiseProduct(size));
  }
  part.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return part;
}

inline Mesh mesh_of(std::vector<SubMesh> parts) {
  auto file = std::make_shared<MeshFile>();
  file->path = "test.dae";
  file->parts = std::move(parts);
  Mesh mesh;
  mesh.file = file;
  mesh.uri = "test.dae";
  return mesh;
}

/// Returns beams in the sensor's xy plane.
inline RayPattern fan(int count, double from_rad, double to_rad) {
  RayPattern pattern;
  for (int k = 0; k < count; ++k) {
    const double angle = count == 1 ? from_rad : from_rad + (to_rad - from_rad) * k / (count - 1);
    pattern.directions_S.emplace_back(static_cast<float>(std::cos(angle)),
                                      static_cast<float>(std::sin(angle)), 0.0f);
  }
  return pattern;
}

inline RayPattern towards(const Eigen::Vector3d& direction) {
  return {{direction.normalized().cast<float>()}};
}

/// Returns evenly random directions.
inline RayPattern random_pattern(int count, std::uint64_t seed) {
  Rng rng(mix_bits(seed));
  RayPattern pattern;
  for (int k = 0; k < count; ++k) {
    const double z = 2.0 * rng.uniform() - 1.0;
    const double angle = 2.0 * kPi * rng.uniform();
    const double r = std::sqrt(1.0 - z * z);
    pattern.directions_S.push_back(
        Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), z).normalized().cast<float>());
  }
  return pattern;
}

/// Returns a picture's rays in those directions, each from `near_m` to `far_m`, in whole blocks.
inline std::vector<PrimaryRayPacket> blocks_of(const RayPattern& pattern, float near_m,
                                               float far_m) {
  std::vector<PrimaryRayPacket> blocks(pattern.directions_S.size() / PrimaryRayPacket::kRays);
  for (std::size_t k = 0; k < blocks.size() * PrimaryRayPacket::kRays; ++k) {
    PrimaryRayPacket& block = blocks[k / PrimaryRayPacket::kRays];
    const int i = static_cast<int>(k % PrimaryRayPacket::kRays);
    block.set_direction(i, pattern.directions_S[k].normalized());
    block.near_m[i] = near_m;
    block.far_m[i] = far_m;
  }
  return blocks;
}

inline RayOptions instances_only() {
  RayOptions options;
  options.local_scenes = false;
  return options;
}

/// Scene with static placements, ready for a sensor at any place; it traces ray after ray.
class TestScene {
 public:
  explicit TestScene(SceneKind kind, const RayOptions& options = {})
      : scene(kind, options, Log()) {}
  TestScene(SceneKind kind, const RayOptions& options, std::uint32_t first_entity,
            const std::vector<Placement>& placements)
      : TestScene(kind, options) {
    scene.add_scenery(first_entity, placements);
  }

  std::vector<RayHit> cast(const Pose& X_WS, const RayPattern& pattern, float max_m = 100.0f,
                           std::uint32_t own_entity = kNoEntity, std::uint32_t own_link = 0) {
    std::vector<RayHit> hits;
    scene.prepare({X_WS.p});
    scene.cast(X_WS, pattern, max_m, own_entity, own_link, hits);
    return hits;
  }
  RayHit one(const Eigen::Vector3d& from, const Eigen::Vector3d& direction, float max_m = 100.0f) {
    return cast({from, Eigen::Quaterniond::Identity()}, towards(direction), max_m).front();
  }

  RayScene scene;
};

}  // namespace ardee::test
