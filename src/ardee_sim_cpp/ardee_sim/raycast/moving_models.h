// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "ardee_sim/core/log.h"
#include "ardee_sim/raycast/moving_model.h"
#include "ardee_sim/raycast/place_tree.h"
#include "ardee_sim/raycast/scene_kind.h"
#include "ardee_sim/raycast/still_instance.h"

namespace ardee::raycast {

/// Models whose links can move. Few do at a time: a box test a link is quicker than a tree that is
/// rebuilt with each motion. Models at rest, which may be hundreds of plants, are in a tree.
class MovingModels {
 public:
  MovingModels(SceneKind kind, Log& log) : kind_(kind), log_(log) {}

  void add(std::uint32_t entity, std::shared_ptr<const Model> model, std::uint32_t label);
  void remove(std::uint32_t entity);
  void set_link_poses(std::uint32_t entity, const std::vector<Pose>& X_WL);
  /// Moves models at rest into the tree, once they are many. Call it before rays are cast among new
  /// poses.
  void prepare();
  bool empty() const { return models_.empty(); }

  /// Models that are not in the tree.
  const ModelList& loose() const { return loose_; }
  const PlaceTree& tree() const { return tree_; }
  /// Intersects the first `count` of the queries, neighbouring rays, with loose models and the
  /// tree.
  void intersect(RayQuery queries[kPacketRays], int count) const;
  void intersect(RayQuery& query, std::uint32_t entity) const;

  /// Number of calls of prepare().
  std::uint64_t time() const { return time_; }
  /// Links in the tree, for the triangle scenes.
  StillInstances still_instances() const;
  /// Returns whether still_instances() had this model at that time, at its present place.
  static bool was_still(const MovingModel& model, std::uint64_t at_time) {
    return model.in_tree && model.stays_since <= at_time && *model.moved_at <= at_time;
  }
  /// Returns whether the model has not moved for long.
  bool is_at_rest(const MovingModel& model) const;
  const std::map<std::uint32_t, MovingModel>& models() const { return models_; }

 private:
  void loosen(MovingModel& model);

  SceneKind kind_;
  Log& log_;
  std::map<std::uint32_t, MovingModel> models_;
  ModelList loose_;  // models with shapes that are not in the tree
  PlaceTree tree_;   // links of the others; one that has left its room is skipped
  std::uint64_t time_ = 1;
};

}  // namespace ardee::raycast
