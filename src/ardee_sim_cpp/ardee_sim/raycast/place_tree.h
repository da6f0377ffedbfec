// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "ardee_sim/raycast/ray_query.h"

namespace ardee::raycast {

/// Placed bodies, one box each, with an Embree scene over the boxes.
class PlaceTree {
 public:
  /// Builds the tree. The bodies must stay where they are in memory until the next build. In the
  /// world they may move as long as they stay in their boxes, which are `room_m` larger than at the
  /// build.
  void build(std::vector<const TraceableInstance*> places, BuildQuality quality,
             double room_m = 0.0);
  void clear();

  bool empty() const { return places_.empty(); }
  const std::vector<const TraceableInstance*>& places() const { return places_; }
  const Bounds& bounds_W() const { return bounds_W_; }

  /// Intersects each query from its t_low on (infinity: not at all).
  void intersect(RayQuery queries[kPacketRays], const double t_low[kPacketRays]) const;

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

  static void intersect_place(const RTCIntersectFunctionNArguments* args);

  std::vector<const TraceableInstance*> places_;
  std::vector<FloatBox> boxes_;  // the boxes of places_, relative to origin_W_
  Eigen::Vector3d origin_W_ = Eigen::Vector3d::Zero();
  Bounds bounds_W_;
  std::unique_ptr<EmbreeScene> scene_;
};

}  // namespace ardee::raycast
