// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <memory>
#include <mutex>
#include <vector>

#include "ardee_sim/raycast/place_tree.h"

namespace ardee::raycast {

class LocalScene;

/// Memory limits of a local scene [bytes].
struct LocalSceneBudget {
  std::size_t entries;
  std::size_t triangle_bytes = 0;  // 0: without pictures
};

/// The square of ground that a local scene shall cover.
struct LocalSceneRequest {
  Eigen::Vector2d center_W;
  double half_size_m;
  LocalSceneBudget budget;
};

/// Places that were added together.
struct SceneryGroup {
  std::uint32_t first_entity = 0;
  std::size_t count = 0;
  std::vector<TraceableInstance> placed;
  std::vector<std::shared_ptr<const Traceable>> bodies;  // each once
};

/// All fixed bodies of a world, with an Embree scene over their places. It does not change, so that
/// many simulations of one world share it, and the local scenes in it.
class FixedScenery : public std::enable_shared_from_this<FixedScenery> {
 public:
  using Groups = std::vector<std::shared_ptr<const SceneryGroup>>;

  /// Returns scenery of these groups, an equal one if this process has it already.
  static std::shared_ptr<const FixedScenery> of(Groups groups);

  const Groups& groups() const { return groups_; }
  /// Places of all bodies with boxes.
  const PlaceTree& places() const { return places_; }
  bool has_unbounded() const { return !unbounded_.empty(); }
  /// Intersects bodies too large for a box: infinite planes, and bodies of kilometres.
  void intersect_unbounded(RayQuery& query) const;

  /// Returns a local scene without models at rest; one that another simulation uses, if it serves.
  /// One for pictures is always about that very centre, because their floats depend on it.
  std::shared_ptr<const LocalScene> local_scene(const LocalSceneRequest& request) const;

 private:
  /// A local scene that is being made, or was.
  struct Slot {
    LocalSceneRequest request;
    std::mutex making;
    std::weak_ptr<const LocalScene> scene;  // guarded by mutex_
  };

  explicit FixedScenery(Groups groups);
  /// Returns a local scene that serves, or the slot in which one is to be made.
  std::shared_ptr<const LocalScene> find(const LocalSceneRequest& request,
                                         std::shared_ptr<Slot>& slot) const;

  Groups groups_;
  PlaceTree places_;
  std::vector<const TraceableInstance*> unbounded_;
  mutable std::mutex mutex_;
  mutable std::vector<std::shared_ptr<Slot>> slots_;
};

}  // namespace ardee::raycast
