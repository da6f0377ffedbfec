// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "ardee_sim/raycast/moving_model.h"
#include "ardee_sim/raycast/place_tree.h"
#include "ardee_sim/raycast/scene_kind.h"
#include "ardee_sim/raycast/still_instance.h"

namespace ardee::raycast {

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
  bool empty() const { return models_.empty(); }

  /// Those that are not in the tree.
  const ModelList& loose() const { return loose_; }
  const PlaceTree& tree() const { return tree_; }
  /// The first `count` of the queries, neighbouring rays, by either way.
  void intersect(RayQuery queries[kPacketRays], int count) const;
  void intersect(RayQuery& query, std::uint32_t entity) const;

  /// Calls of prepare().
  std::uint64_t time() const { return time_; }
  /// The links in the tree, for others to be made of.
  StillInstances still_instances() const;
  /// Whether still_instances() had this model at that time, where it is now.
  static bool was_still(const MovingModel& model, std::uint64_t at_time) {
    return model.in_tree && model.stays_since <= at_time && *model.moved_at <= at_time;
  }
  /// Whether it has not moved at all for long.
  bool is_at_rest(const MovingModel& model) const;
  const std::map<std::uint32_t, MovingModel>& models() const { return models_; }

 private:
  std::shared_ptr<const MovingModel::Bodies> bodies_of(const std::shared_ptr<const Model>& model);
  void loosen(MovingModel& model);

  const EmbreeDevice& device_;
  AlphaMasks& masks_;
  SceneKind kind_;
  std::map<const Model*, std::weak_ptr<const MovingModel::Bodies>> compiled_;
  std::map<std::uint32_t, MovingModel> models_;
  ModelList loose_;  // have shapes and are not in the tree
  PlaceTree tree_;   // of the others' links; what has left its room does no harm there
  std::uint64_t time_ = 1;
};

}  // namespace ardee::raycast
