// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "ardee_sim/raycast/primary_ray_packet.h"
#include "ardee_sim/raycast/ray_bundle.h"

namespace ardee::raycast {

/// A ball about something that may throw a shadow.
struct ShadowBall {
  Eigen::Vector3f center_W{0, 0, 0};
  float radius_m = 0.0f;

  ShadowBall() = default;
  explicit ShadowBall(const Bounds& box_W);
  /// Whether it may stand in the way from about a place (within `about_m`) to a lamp.
  bool may_shade(const Eigen::Vector3f& at_W, const Eigen::Vector3f& to_lamp_W,
                 float about_m) const;
};

/// A model whose links can move.
struct MovingModel {
  using Bodies = std::vector<std::unique_ptr<Traceable>>;  // of each link
  static constexpr std::uint64_t kNever = ~std::uint64_t{0};

  std::uint32_t entity = 0;
  std::shared_ptr<const Model> model;
  std::shared_ptr<const Bodies> bodies;
  std::vector<TraceableInstance> placed;  // links that have shapes
  std::vector<std::uint32_t> links;       // their indices
  std::vector<Bounds> boxes_W;            // empty until the first poses
  BoxTable box_table_W;                   // the same
  Bounds box_W;
  ShadowBall ball;

  // Times are calls of prepare().
  std::vector<Bounds> rooms_W;         // about each link, which has stayed there
  std::uint64_t left_at = 0;           // when it last left them; 0: never
  std::uint64_t stays_since = kNever;  // when it was taken into the tree
  bool in_tree = false;
  /// When it last moved at all; 0: never. Shared with what was made of it where it stood.
  std::shared_ptr<std::uint64_t> moved_at = std::make_shared<std::uint64_t>(0);

  void intersect(RayQuery* queries, int count) const;
};

/// Some models, each asked by its boxes.
class ModelList {
 public:
  void clear() { models_.clear(); }
  void add(const MovingModel& model) { models_.push_back(&model); }
  void remove(const MovingModel& model);
  const std::vector<const MovingModel*>& models() const { return models_; }

  /// Whether one of the rays, close together, may touch the box about a link before what it has
  /// met.
  bool may_touch_some(const Eigen::Vector3d& eye_W, const PrimaryRayPacket& rays) const;
  bool may_shade(const Eigen::Vector3f& at_W, const Eigen::Vector3f& to_lamp_W,
                 float about_m) const;
  /// Whether the ray touches the box about one of them within its reach.
  bool touches_any(const Ray& ray_W, double reach_m) const;
  /// The first `count` of the queries, neighbouring rays.
  void intersect(RayQuery queries[kPacketRays], int count) const;

 private:
  std::vector<const MovingModel*> models_;
};

}  // namespace ardee::raycast
