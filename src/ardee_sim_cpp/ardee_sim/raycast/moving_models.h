// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "ardee_sim/raycast/glance.h"
#include "ardee_sim/raycast/place_tree.h"
#include "ardee_sim/raycast/ray_bundle.h"

namespace ardee {

/// Models whose links can move. Few do at a time: a box test a link beats any tree that would have
/// to be rebuilt with each motion. Those that stay where they are, which may be hundreds of plants,
/// are in a tree.
class MovingModels {
 public:
  MovingModels(const EmbreeDevice& device, AlphaMasks& masks, SceneKind kind)
      : device_(device), masks_(masks), kind_(kind) {}

  void add(std::uint32_t entity, std::shared_ptr<const Model> model);
  void remove(std::uint32_t entity);
  void set_link_poses(std::uint32_t entity, const std::vector<Pose>& X_WL);
  /// Takes those that have stayed where they are into the tree, once they are many. To be called
  /// before rays are cast among poses that were set.
  void prepare();
  bool empty() const { return entries_.empty(); }
  /// Whether one of the rays, close together, may touch the box about a link before what it has
  /// met.
  bool may_touch_some(const Eigen::Vector3d& eye_W, const GlanceBlock& rays) const;
  /// Whether one of them may stand in the way from about a place (within `about_m`) to a lamp.
  bool may_shade(const Eigen::Vector3f& at_W, const Eigen::Vector3f& to_lamp_W,
                 float about_m) const;
  /// Whether the ray touches the box about one of them within its reach.
  bool touches_any(const Ray& ray_W, double reach_m) const;
  /// The first `count` of the queries, neighbouring rays.
  void meet(RayQuery queries[kPacketRays], int count) const;
  void meet(RayQuery& query, std::uint32_t entity) const;

 private:
  using Bodies = std::vector<std::unique_ptr<Body>>;  // of each link
  struct Entry {
    std::uint32_t entity = 0;
    std::shared_ptr<const Model> model;
    std::shared_ptr<const Bodies> bodies;
    std::vector<PlacedBody> placed;    // links that have shapes
    std::vector<std::uint32_t> links;  // their indices
    std::vector<Bounds> boxes_W;       // empty until the first poses
    BoxTable box_table_W;              // the same
    Bounds box_W;
    Eigen::Vector3f center_W{0, 0, 0};  // of a ball about it
    float radius_m = 0.0f;
    std::vector<Bounds> rooms_W;  // about each link, which has stayed there
    std::uint64_t left_at = 0;    // time when it last left them; 0: never
    bool in_tree = false;
  };

  std::shared_ptr<const Bodies> bodies_of(const std::shared_ptr<const Model>& model);
  static void make_room(Entry& entry);
  void loosen(Entry& entry);
  static void meet(RayQuery* queries, int count, const Entry& entry);

  const EmbreeDevice& device_;
  AlphaMasks& masks_;
  SceneKind kind_;
  std::map<const Model*, std::weak_ptr<const Bodies>> compiled_;
  std::map<std::uint32_t, Entry> entries_;
  std::vector<Entry*> loose_;  // have shapes and are not in the tree
  PlaceTree tree_;             // of the others' links; what has left its room does no harm there
  BoxTable tree_box_W_;        // about all of it
  std::uint64_t time_ = 1;     // calls of prepare()
};

}  // namespace ardee
