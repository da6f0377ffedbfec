// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/local_scene_cache.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace ardee::raycast {
namespace {

/// One local scene may use 1 / kBudgetShare of the budget, so that several robots find room.
constexpr std::size_t kBudgetShare = 4;
/// Share of the requested radius by which the square is larger, so that it lasts for a while.
constexpr double kSpareShare = 0.5;
/// Least radius of a local scene for pictures, if the budget allows.
constexpr double kPictureRadius_m = 12.0;
/// Distance of the next local scene's centre ahead of the sensor, as a share of the way that a
/// sensor may go from a centre: less than 1, so that a sensor that turns back is still within it.
constexpr double kAhead = 0.75;
/// For pictures, distance from the centre at which the next local scene is asked for, as a share of
/// half the side.
constexpr double kPictureReserve = 0.25;
/// Distance from the centre at which pictures take the next local scene over, as a share of the way
/// at which it is asked for: it is made in between.
constexpr double kLatest = 1.5;
/// Number of calls after which a local scene without a sensor is dropped.
constexpr std::uint64_t kIdleCalls = 2000;

Eigen::Vector2d way_from(const LocalScene& local, const Eigen::Vector3d& eye_W) {
  return eye_W.head<2>() - local.center_W();
}

/// Returns how far a sensor may be from the centre before another local scene is made.
double reserve_m(const LocalScene& local) {
  const double share =
      local.is_for_pictures() ? kPictureReserve : kSpareShare / (1.0 + kSpareShare);
  return share * local.half_size_m();
}

}  // namespace

double LocalSceneCache::slack_m() const { return kSpareShare * options_.local_scene_radius_m; }

double LocalSceneCache::wanted_half_size_m() const {
  // A picture sees farther than a scan.
  const double radius_m = options_.local_scene_radius_m;
  return slack_m() + (for_pictures_ ? std::max(radius_m, kPictureRadius_m) : radius_m);
}

LocalSceneInUse LocalSceneCache::make(const StillInstances& still,
                                      const Eigen::Vector2d& center_W) const {
  LocalSceneRequest request{
      center_W, options_.local_scene_radius_m, {options_.local_scene_budget_bytes / kBudgetShare}};
  if (for_pictures_) {
    // The triangles take the most room.
    request.budget.triangle_bytes = options_.local_scene_budget_bytes / 2;
  }
  request.half_size_m = wanted_half_size_m();
  auto scene = still.bodies.empty()
                   ? store_.fixed()->local_scene(request)
                   : std::make_shared<const LocalScene>(store_.fixed(), still, request);
  return {std::move(scene), ModelsBeside(still.time)};
}

LocalSceneInUse LocalSceneCache::make_about(const Eigen::Vector3d& eye_W) {
  const StillInstances still = still_instances();
  const Bounds all = store_.fixed()->places().bounds_W();
  if (for_pictures_ && still.bodies.empty() && !is_whole_tried_ && !all.empty()) {
    const Eigen::Vector2d half = 0.5 * (all.upper - all.lower).head<2>();
    if (half.maxCoeff() <= wanted_half_size_m()) {
      LocalSceneInUse made = make(still, all.center().head<2>());
      if (made.scene->holds_all()) whole_ = made.scene;
    }
    is_whole_tried_ = true;
  }
  if (still.bodies.empty() && whole_ != nullptr && whole_->depth_m(eye_W) > 0.0) {
    return {whole_, ModelsBeside(still.time)};
  }
  return make(still, eye_W.head<2>());
}

/// Returns the models at rest, which only pictures treat as scenery.
StillInstances LocalSceneCache::still_instances() const {
  return for_pictures_ ? moving_.still_instances() : StillInstances{};
}

bool LocalSceneCache::serves(const LocalSceneInUse& local, const Eigen::Vector3d& eye_W,
                             double share) const {
  const LocalScene& scene = *local.scene;
  if (for_pictures_ && (!scene.is_for_pictures() || local.beside.outdate())) return false;
  return scene.holds_all() || way_from(scene, eye_W).norm() <= share * reserve_m(scene);
}

bool LocalSceneCache::is_served(const Eigen::Vector3d& eye_W, double share) const {
  return std::any_of(kept_.begin(), kept_.end(),
                     [&](const auto& kept) { return serves(kept, eye_W, share); });
}

void LocalSceneCache::drop() {
  if (next_.valid()) next_.wait();
  next_ = {};
  kept_.clear();
}

void LocalSceneCache::clear() {
  drop();
  whole_.reset();
  is_whole_tried_ = false;
}

PicturePlaces LocalSceneCache::picture_places() const {
  if (places_) return *places_;
  PicturePlaces places;
  if (!for_pictures_) return places;
  places.has_pictures = true;
  places.time = tick_;
  for (const LocalSceneInUse& kept : kept_) {
    places.kept.emplace_back(kept.scene->center_W(), kept.last_used);
  }
  if (next_.valid()) places.next = next_center_W_;
  return places;
}

void LocalSceneCache::set_picture_places(PicturePlaces places) {
  if (for_pictures_ || places.has_pictures || places_) places_ = std::move(places);
}

void LocalSceneCache::go_to_places() {
  const auto before = std::exchange(kept_, {});  // so that equal ones are found, not made
  drop();
  for_pictures_ = places_->has_pictures;
  tick_ = places_->time;
  for (const auto& [center_W, last_used] : places_->kept) {
    kept_.push_back(make(still_instances(), center_W));
    kept_.back().last_used = last_used;
  }
  if (places_->next) ask_for_next(*places_->next);
  places_.reset();
}

void LocalSceneCache::ask_for_next(const Eigen::Vector2d& center_W) {
  next_center_W_ = center_W;
  next_ = std::async(std::launch::async,
                     [this, still = still_instances(), center_W] { return make(still, center_W); });
}

const LocalSceneInUse* LocalSceneCache::find(const Eigen::Vector3d& eye_W) const {
  const LocalSceneInUse* best = nullptr;
  double depth_m = 0.0;
  for (const LocalSceneInUse& kept : kept_) {
    if (kept.scene->depth_m(eye_W) > depth_m) {
      depth_m = kept.scene->depth_m(eye_W);
      best = &kept;
    }
  }
  return best;
}

void LocalSceneCache::keep(LocalSceneInUse local) {
  // A new local scene makes others superfluous: those about it, idle ones, then those that are
  // unused longest.
  const double close_m = 2.0 * slack_m() + 1e-6;
  std::size_t total = local.scene->bytes();
  std::sort(kept_.begin(), kept_.end(),
            [](const auto& a, const auto& b) { return a.last_used > b.last_used; });
  std::vector<LocalSceneInUse> others;
  for (LocalSceneInUse& kept : kept_) {
    const Eigen::Vector2d way = kept.scene->center_W() - local.scene->center_W();
    const bool near = way.cwiseAbs().maxCoeff() <= close_m;
    const bool idle = kept.last_used + kIdleCalls < tick_;
    total += kept.scene->bytes();
    if (!near && !idle && total <= options_.local_scene_budget_bytes)
      others.push_back(std::move(kept));
  }
  kept_ = std::move(others);
  local.last_used = tick_;
  kept_.push_back(std::move(local));
  ++taken_;
}

void LocalSceneCache::collect(const std::vector<Eigen::Vector3d>& eyes_W) {
  if (!next_.valid()) return;
  // Scans are the same in any local scene. Pictures may differ where floats decide: so the time at
  // which a local scene is taken over must not depend on the machine's speed.
  const bool due = for_pictures_
                       ? !std::all_of(eyes_W.begin(), eyes_W.end(),
                                      [&](const auto& eye_W) { return is_served(eye_W, kLatest); })
                       : next_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  if (due) keep(next_.get());
}

void LocalSceneCache::prepare(const Eigen::Vector3d& eye_W) {
  const LocalSceneInUse* local = find(eye_W);
  if (local == nullptr || (for_pictures_ && !local->scene->is_for_pictures())) {
    keep(make_about(eye_W));
    return;
  }
  const LocalScene& scene = *local->scene;
  for (LocalSceneInUse& kept : kept_) {
    if (&kept == local) kept.last_used = tick_;
  }
  if (next_.valid() || is_served(eye_W, 1.0)) return;
  const Eigen::Vector2d way = way_from(scene, eye_W);
  double ahead_m = kAhead * reserve_m(scene);
  if (for_pictures_ && serves(*local, eye_W, kLatest)) {
    ahead_m += kLatest * reserve_m(scene) - way.norm();
  }
  ask_for_next(eye_W.head<2>() + ahead_m * way.normalized());
}

void LocalSceneCache::prepare(const std::vector<Eigen::Vector3d>& eyes_W, bool pictures) {
  if (places_) go_to_places();
  ++tick_;
  collect(eyes_W);
  if (pictures && !for_pictures_) {
    // Those of scans may have come from another simulation, and pictures must not depend on that.
    drop();
    for_pictures_ = true;
  }
  const bool any = !store_.fixed()->places().empty() || (for_pictures_ && !moving_.tree().empty());
  if (options_.local_scenes && any) {
    for (const Eigen::Vector3d& eye : eyes_W) prepare(eye);
  }
  for (LocalSceneInUse& kept : kept_) {
    if (kept.scene->triangle_scene() != nullptr) kept.beside.find(*kept.scene, moving_);
  }
}

std::size_t LocalSceneCache::bytes() const {
  std::size_t sum = 0;
  bool is_whole_kept = whole_ == nullptr;
  for (const LocalSceneInUse& kept : kept_) {
    sum += kept.scene->bytes();
    is_whole_kept = is_whole_kept || kept.scene == whole_;
  }
  return is_whole_kept ? sum : sum + whole_->bytes();
}

std::size_t LocalSceneCache::triangles() const {
  std::size_t sum = 0;
  for (const LocalSceneInUse& kept : kept_) sum += kept.scene->triangles();
  return sum;
}

}  // namespace ardee::raycast
