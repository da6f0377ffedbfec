// SPDX-License-Identifier: MIT
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "ardee_sim/raycast/local_scene.h"
#include "ardee_sim/raycast/models_beside.h"
#include "ardee_sim/raycast/picture_places.h"
#include "ardee_sim/raycast/ray_options.h"
#include "ardee_sim/raycast/scenery_store.h"

namespace ardee::raycast {

/// Local scene in use, with the models beside it.
struct LocalSceneInUse {
  std::shared_ptr<const LocalScene> scene;
  ModelsBeside beside;
  std::uint64_t last_used = 0;
};

/// Keeps a local scene about each place with sensors. A sensor's first local scene is made at once;
/// while it drives, a background thread makes the next one, which replaces the first once it is
/// ready; for pictures, once the sensor is far enough. Rays return the same with either, or none.
/// Where all scenery fits into a local scene for pictures, that one lies about its middle, wherever
/// the camera is.
class LocalSceneCache {
 public:
  LocalSceneCache(const SceneryStore& store, const MovingModels& moving, const RayOptions& options)
      : store_(store), moving_(moving), options_(options) {}
  ~LocalSceneCache() { clear(); }

  /// Waits for the background thread and drops all local scenes: the scenery is about to change.
  void clear();
  PicturePlaces picture_places() const;
  /// Makes the local scenes of pictures anew about other places, at the next prepare().
  void set_picture_places(PicturePlaces places);
  /// Makes local scenes about these points; with `pictures`, also triangle scenes.
  void prepare(const std::vector<Eigen::Vector3d>& eyes_W, bool pictures);
  /// Returns the local scene in which the point lies deepest, or nullptr.
  const LocalSceneInUse* find(const Eigen::Vector3d& eye_W) const;

  std::size_t bytes() const;
  std::size_t triangles() const;
  /// Number of local scenes that were taken into use so far.
  std::size_t taken() const { return taken_; }

 private:
  double slack_m() const;
  LocalSceneInUse make(const StillInstances& still, const Eigen::Vector2d& center_W) const;
  double wanted_half_size_m() const;
  /// Returns the local scene in which a camera's first pictures are traced.
  LocalSceneInUse make_about(const Eigen::Vector3d& eye_W);
  void ask_for_next(const Eigen::Vector2d& center_W);
  void drop();
  void go_to_places();
  StillInstances still_instances() const;
  /// Returns whether the point is less far from the centre than `share` of the way at which the
  /// next local scene is asked for.
  bool serves(const LocalSceneInUse& local, const Eigen::Vector3d& eye_W, double share) const;
  bool is_served(const Eigen::Vector3d& eye_W, double share) const;
  /// Takes the next local scene over if it is time.
  void collect(const std::vector<Eigen::Vector3d>& eyes_W);
  void prepare(const Eigen::Vector3d& eye_W);
  void keep(LocalSceneInUse local);

  const SceneryStore& store_;
  const MovingModels& moving_;
  const RayOptions options_;
  std::vector<LocalSceneInUse> kept_;
  std::future<LocalSceneInUse> next_;
  Eigen::Vector2d next_center_W_{0, 0};
  std::shared_ptr<const LocalScene> whole_;  // that holds all scenery, as long as it stays
  bool is_whole_tried_ = false;
  std::optional<PicturePlaces> places_;  // to go to
  std::uint64_t tick_ = 0;
  std::size_t taken_ = 0;
  bool for_pictures_ = false;
};

}  // namespace ardee::raycast
