// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "ardee_sim/raycast/ray_scene.h"

namespace ardee::bench {

/// Bare rtcIntersect8 calls on the scene that RayScene commits near a sensor: without lists of
/// hits, moving models and threads.
class BareRegion {
 public:
  BareRegion(const std::vector<Placement>& field, const Eigen::Vector3d& eye,
             const raycast::RayOptions& options);
  ~BareRegion();
  void cast(const Pose& X_WS, const raycast::RayPattern& pattern, float max_range_m) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Bare rtcIntersect1 calls on one flat triangle scene of all plants in a square about the origin.
class FlatField {
 public:
  FlatField(const std::vector<Placement>& field, double half_size_m);
  ~FlatField();
  void cast(const Pose& X_WS, const raycast::RayPattern& pattern, float max_range_m) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ardee::bench
