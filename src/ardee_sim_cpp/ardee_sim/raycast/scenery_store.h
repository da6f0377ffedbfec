// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "ardee_sim/description/scenery.h"
#include "ardee_sim/raycast/place_tree.h"
#include "ardee_sim/raycast/scene_kind.h"

namespace ardee::raycast {

/// All fixed bodies: each description compiled once, each place a few numbers, and one Embree scene
/// over the places.
class SceneryStore {
 public:
  SceneryStore(const EmbreeDevice& device, AlphaMasks& masks, SceneKind kind)
      : device_(device), masks_(masks), kind_(kind) {}

  /// Throws Error and adds nothing if a placement is invalid.
  void add(std::uint32_t first_entity, const std::vector<Placement>& placements);
  void remove(std::uint32_t first_entity);
  /// Rebuilds the scene over the places.
  void commit();
  bool committed() const { return committed_; }

  bool has_unbounded() const { return !unbounded_.empty(); }
  /// Intersects bodies too large for a box: infinite planes, and bodies of kilometres.
  void intersect_unbounded(RayQuery& query) const;
  /// Places of all bodies with boxes.
  const PlaceTree& places() const { return places_; }

 private:
  struct Compiled {
    std::shared_ptr<const Model> model;
    std::unique_ptr<Traceable> body;
    std::size_t uses = 0;
  };
  struct Group {
    std::size_t count = 0;
    std::vector<TraceableInstance> placed;
    std::vector<const Model*> models;  // each once
  };

  void check(std::uint32_t first_entity, const std::vector<Placement>& placements) const;
  void release(const Group& group);
  const Traceable* use_body(const std::shared_ptr<const Model>& model, Group& group);

  const EmbreeDevice& device_;
  AlphaMasks& masks_;
  SceneKind kind_;
  std::map<const Model*, Compiled> bodies_;
  std::map<std::uint32_t, Group> groups_;
  bool committed_ = true;
  PlaceTree places_;
  std::vector<const TraceableInstance*> unbounded_;
};

}  // namespace ardee::raycast
