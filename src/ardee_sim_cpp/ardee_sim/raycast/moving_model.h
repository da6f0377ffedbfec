// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "ardee_sim/raycast/primary_ray_packet.h"
#include "ardee_sim/raycast/ray_bundle.h"

namespace ardee::raycast {

/// Ball about a body that may cast a shadow.
struct ShadowBall {
  Eigen::Vector3f center_W{0, 0, 0};
  float radius_m = 0.0f;

  ShadowBall() = default;
  explicit ShadowBall(const Bounds& box_W);
  /// Returns whether the ball may stand between a place (within `about_m`) and a lamp.
  bool may_shade(const Eigen::Vector3f& at_W, const Eigen::Vector3f& to_lamp_W,
                 float about_m) const;
};

/// Model whose links can move.
struct MovingModel {
  static constexpr std::uint64_t kNever = ~std::uint64_t{0};

  std::uint32_t entity = 0;
  std::shared_ptr<const Model> model;
  std::shared_ptr<const TraceableBodies> bodies;  // one a link
  std::vector<TraceableInstance> placed;          // links that have shapes
  std::vector<std::uint32_t> links;               // their indices
  std::vector<Bounds> boxes_W;                    // empty until the first poses
  BoxTable box_table_W;                           // the same boxes
  Bounds box_W;
  ShadowBall ball;

  // Times are calls of prepare().
  std::vector<Bounds> rooms_W;         // about each link, which has stayed there
  std::uint64_t left_at = 0;           // when it last left them; 0: never
  std::uint64_t stays_since = kNever;  // when it entered the tree
  bool in_tree = false;
  /// Call of prepare() at which it last moved; 0: never. Shared with its still instances.
  std::shared_ptr<std::uint64_t> moved_at = std::make_shared<std::uint64_t>(0);

  void intersect(RayQuery* queries, int count) const;
};

/// Models whose link boxes are tested one by one.
class ModelList {
 public:
  void clear() { models_.clear(); }
  void add(const MovingModel& model) { models_.push_back(&model); }
  void remove(const MovingModel& model);
  const std::vector<const MovingModel*>& models() const { return models_; }

  /// Returns whether one of the neighbouring rays may touch the box about a link before its present
  /// hit.
  bool may_touch_some(const Eigen::Vector3d& eye_W, const PrimaryRayPacket& rays) const;
  bool may_shade(const Eigen::Vector3f& at_W, const Eigen::Vector3f& to_lamp_W,
                 float about_m) const;
  /// Returns whether the ray touches the box about a link within its reach.
  bool touches_any(const Ray& ray_W, double reach_m) const;
  /// Intersects the first `count` of the queries, neighbouring rays.
  void intersect(RayQuery queries[kPacketRays], int count) const;

 private:
  std::vector<const MovingModel*> models_;
};

}  // namespace ardee::raycast
