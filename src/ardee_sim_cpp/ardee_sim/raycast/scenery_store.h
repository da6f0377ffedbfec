// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "ardee_sim/raycast/ray_query.h"

namespace ardee {

/// All that stands still: each description compiled once, each place a few numbers, and one Embree
/// scene over the places.
class SceneryStore {
 public:
  SceneryStore(const EmbreeDevice& device, AlphaMasks& masks, SceneKind kind)
      : device_(device), masks_(masks), kind_(kind) {}

  /// Throws Error and adds nothing if a placement is not usable.
  void add(std::uint32_t first_entity, const std::vector<Placement>& placements);
  void remove(std::uint32_t first_entity);
  /// Rebuilds the scene over the places.
  void commit();
  bool committed() const { return committed_; }

  bool has_everywhere() const { return !everywhere_.empty(); }
  /// What is too large to be put in any box: infinite planes, and bodies of kilometres.
  void meet_everywhere(RayQuery& query) const;
  /// The places, each query from its t_low on (infinity: not at all).
  void meet_places(RayQuery queries[kPacketRays], const double t_low[kPacketRays]) const;

  const std::vector<const PlacedBody*>& places() const { return places_; }
  const Bounds& bounds_W() const { return bounds_W_; }
  /// Calls `found(index in places)` for places whose box touches the rectangle.
  template <typename Found>
  void find(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper, Found found) const {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const FloatBox& box = boxes_[i];
      const bool apart =
          origin_W_.x() + box.lower[0] > upper.x() || origin_W_.y() + box.lower[1] > upper.y() ||
          origin_W_.x() + box.upper[0] < lower.x() || origin_W_.y() + box.upper[1] < lower.y();
      if (!apart) found(i);
    }
  }

 private:
  struct FloatBox {
    float lower[3];
    float upper[3];
  };
  struct Compiled {
    std::shared_ptr<const Model> model;
    std::unique_ptr<Body> body;
    std::size_t uses = 0;
  };
  struct Group {
    std::size_t count = 0;
    std::vector<PlacedBody> placed;
    std::vector<const Model*> models;  // each once
  };

  static void meet_place(const RTCIntersectFunctionNArguments* args);
  void check(std::uint32_t first_entity, const std::vector<Placement>& placements) const;
  void release(const Group& group);
  const Body* use_body(const std::shared_ptr<const Model>& model, Group& group);

  const EmbreeDevice& device_;
  AlphaMasks& masks_;
  SceneKind kind_;
  std::map<const Model*, Compiled> bodies_;
  std::map<std::uint32_t, Group> groups_;
  bool committed_ = true;
  std::vector<const PlacedBody*> places_;
  std::vector<const PlacedBody*> everywhere_;
  std::vector<FloatBox> boxes_;  // of places_, relative to origin_W_
  Eigen::Vector3d origin_W_ = Eigen::Vector3d::Zero();
  Bounds bounds_W_;
  std::unique_ptr<EmbreeScene> scene_;
};

}  // namespace ardee
