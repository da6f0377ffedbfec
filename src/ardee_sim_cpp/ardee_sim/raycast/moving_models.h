// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "ardee_sim/raycast/glance.h"
#include "ardee_sim/raycast/ray_bundle.h"
#include "ardee_sim/raycast/ray_query.h"

namespace ardee {

/// Models whose links move. They are few: a box test a link beats any tree that would have to be
/// rebuilt with each motion.
class MovingModels {
 public:
  MovingModels(const EmbreeDevice& device, AlphaMasks& masks, SceneKind kind)
      : device_(device), masks_(masks), kind_(kind) {}

  void add(std::uint32_t entity, std::shared_ptr<const Model> model);
  void remove(std::uint32_t entity);
  void set_link_poses(std::uint32_t entity, const std::vector<Pose>& X_WL);
  bool empty() const { return entries_.empty(); }
  /// Whether one of the rays, close together, may touch the box about a link before what it has
  /// met.
  bool may_touch_some(const Eigen::Vector3d& eye_W, const GlanceBlock& rays) const;
  /// Whether one of them may stand in the way from about a place (within `about_m`) to a lamp.
  bool may_shade(const Eigen::Vector3f& at_W, const Eigen::Vector3f& to_lamp_W,
                 float about_m) const;
  /// Whether the ray touches the box about one of them within its reach.
  bool touches_any(const Ray& ray_W, double reach_m) const;
  void meet(RayQuery& query) const { meet(&query, 1); }
  /// Neighbouring rays.
  void meet(RayQuery* queries, int count) const;
  void meet(RayQuery& query, std::uint32_t entity) const;

 private:
  struct Entry {
    std::shared_ptr<const Model> model;
    std::vector<std::unique_ptr<Body>> bodies;  // of each link
    std::vector<PlacedBody> placed;             // links that have shapes
    std::vector<std::uint32_t> links;           // their indices
    std::vector<Bounds> boxes_W;                // empty until the first poses
    BoxTable box_table_W;                       // the same
    Bounds box_W;
    Eigen::Vector3f center_W{0, 0, 0};  // of a ball about it
    float radius_m = 0.0f;
  };

  static void meet(RayQuery* queries, int count, std::uint32_t entity, const Entry& entry);

  const EmbreeDevice& device_;
  AlphaMasks& masks_;
  SceneKind kind_;
  std::map<std::uint32_t, Entry> entries_;
};

}  // namespace ardee
