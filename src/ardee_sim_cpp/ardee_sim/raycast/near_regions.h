// SPDX-License-Identifier: MIT
#pragma once

#include <future>
#include <memory>
#include <vector>

#include "ardee_sim/raycast/near_region.h"

namespace ardee {

/// Keeps a region about each place where sensors are. A sensor's first region is made at once;
/// while it drives, the next one is made by a thread in the background and taken over when it is
/// ready. Rays return the same with either, or none.
class NearRegions {
 public:
  NearRegions(const EmbreeDevice& device, const SceneryStore& store, const MovingModels& moving,
              const RayOptions& options)
      : device_(device), store_(store), moving_(moving), options_(options) {}
  ~NearRegions() { clear(); }

  /// Waits for the background and forgets all regions: the scenery is about to change.
  void clear();
  /// With `drafts`, also for pictures.
  void prepare(const std::vector<Eigen::Vector3d>& eyes_W, bool drafts);
  /// The region that holds the point deepest, or nullptr.
  const NearRegion* find(const Eigen::Vector3d& eye_W) const;

  std::size_t bytes() const;
  std::size_t triangles() const;
  std::size_t made() const { return made_; }

 private:
  struct Kept {
    std::unique_ptr<NearRegion> region;
    std::uint64_t last_used = 0;
  };

  double slack_m() const;
  std::unique_ptr<NearRegion> make(const StillBodies& still, const Eigen::Vector2d& center_W) const;
  StillBodies still_bodies() const;
  bool serves(const NearRegion& region, const Eigen::Vector3d& eye_W) const;
  void collect();
  void prepare(const Eigen::Vector3d& eye_W);
  void keep(std::unique_ptr<NearRegion> region);

  const EmbreeDevice& device_;
  const SceneryStore& store_;
  const MovingModels& moving_;
  const RayOptions options_;
  std::vector<Kept> kept_;
  std::future<std::unique_ptr<NearRegion>> next_;
  std::uint64_t tick_ = 0;
  std::size_t made_ = 0;
  bool drafts_ = false;
};

}  // namespace ardee
