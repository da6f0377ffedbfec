// SPDX-License-Identifier: MIT
#pragma once

#include <future>
#include <memory>
#include <vector>

#include "ardee_sim/raycast/local_scene.h"
#include "ardee_sim/raycast/ray_options.h"

namespace ardee::raycast {

/// Keeps a local scene about each place with sensors. A sensor's first local scene is made at once;
/// while it drives, a background thread makes the next one, which replaces the first once it is
/// ready. Rays return the same with either, or none.
class LocalSceneCache {
 public:
  LocalSceneCache(const EmbreeDevice& device, const SceneryStore& store, const MovingModels& moving,
                  const RayOptions& options)
      : device_(device), store_(store), moving_(moving), options_(options) {}
  ~LocalSceneCache() { clear(); }

  /// Waits for the background thread and drops all local scenes: the scenery is about to change.
  void clear();
  /// Makes local scenes about these points; with `pictures`, also triangle scenes.
  void prepare(const std::vector<Eigen::Vector3d>& eyes_W, bool pictures);
  /// Returns the local scene in which the point lies deepest, or nullptr.
  const LocalScene* find(const Eigen::Vector3d& eye_W) const;

  std::size_t bytes() const;
  std::size_t triangles() const;
  std::size_t made() const { return made_; }

 private:
  struct Kept {
    std::unique_ptr<LocalScene> local;
    std::uint64_t last_used = 0;
  };

  double slack_m() const;
  std::unique_ptr<LocalScene> make(const StillInstances& still,
                                   const Eigen::Vector2d& center_W) const;
  StillInstances still_instances() const;
  bool serves(const LocalScene& local, const Eigen::Vector3d& eye_W) const;
  void collect();
  void prepare(const Eigen::Vector3d& eye_W);
  void keep(std::unique_ptr<LocalScene> local);

  const EmbreeDevice& device_;
  const SceneryStore& store_;
  const MovingModels& moving_;
  const RayOptions options_;
  std::vector<Kept> kept_;
  std::future<std::unique_ptr<LocalScene>> next_;
  std::uint64_t tick_ = 0;
  std::size_t made_ = 0;
  bool for_pictures_ = false;
};

}  // namespace ardee::raycast
