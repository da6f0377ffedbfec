// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/local_scene_cache.h"

#include <algorithm>
#include <chrono>

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
/// Number of calls after which a local scene without a sensor is dropped.
constexpr std::uint64_t kIdleCalls = 2000;

Eigen::Vector2d way_from(const LocalScene& local, const Eigen::Vector3d& eye_W) {
  return eye_W.head<2>() - local.center_W();
}

/// Returns how far a sensor may be from the centre before another local scene is made.
double reserve_m(const LocalScene& local) {
  return local.half_size_m() * (kSpareShare / (1.0 + kSpareShare));
}

}  // namespace

double LocalSceneCache::slack_m() const { return kSpareShare * options_.local_scene_radius_m; }

std::unique_ptr<LocalScene> LocalSceneCache::make(const StillInstances& still,
                                                  const Eigen::Vector2d& center_W) const {
  LocalSceneBudget budget{options_.local_scene_budget_bytes / kBudgetShare};
  double radius_m = options_.local_scene_radius_m;
  if (for_pictures_) {
    // A picture sees farther than a scan, but the triangles take the most room.
    radius_m = std::max(radius_m, kPictureRadius_m);
    budget.triangle_bytes = options_.local_scene_budget_bytes / 2;
  }
  return std::make_unique<LocalScene>(device_, store_, still, center_W, radius_m + slack_m(),
                                      budget);
}

/// Returns the models at rest, which only pictures treat as scenery.
StillInstances LocalSceneCache::still_instances() const {
  return for_pictures_ ? moving_.still_instances() : StillInstances{};
}

bool LocalSceneCache::serves(const LocalScene& local, const Eigen::Vector3d& eye_W) const {
  if (for_pictures_ && (!local.is_for_pictures() || local.is_outdated())) return false;
  return local.holds_all() || way_from(local, eye_W).norm() <= reserve_m(local);
}

void LocalSceneCache::clear() {
  if (next_.valid()) next_.wait();
  next_ = {};
  kept_.clear();
}

const LocalScene* LocalSceneCache::find(const Eigen::Vector3d& eye_W) const {
  const LocalScene* best = nullptr;
  double depth_m = 0.0;
  for (const Kept& kept : kept_) {
    if (kept.local->depth_m(eye_W) > depth_m) {
      depth_m = kept.local->depth_m(eye_W);
      best = kept.local.get();
    }
  }
  return best;
}

void LocalSceneCache::keep(std::unique_ptr<LocalScene> local) {
  // A new local scene makes others superfluous: those about it, idle ones, then those that are
  // unused longest.
  const double close_m = 2.0 * slack_m() + 1e-6;
  std::size_t total = local->bytes();
  std::sort(kept_.begin(), kept_.end(),
            [](const Kept& a, const Kept& b) { return a.last_used > b.last_used; });
  std::vector<Kept> still;
  for (Kept& kept : kept_) {
    const bool near = (kept.local->center_W() - local->center_W()).cwiseAbs().maxCoeff() <= close_m;
    const bool idle = kept.last_used + kIdleCalls < tick_;
    total += kept.local->bytes();
    if (!near && !idle && total <= options_.local_scene_budget_bytes)
      still.push_back(std::move(kept));
  }
  kept_ = std::move(still);
  kept_.push_back({std::move(local), tick_});
  ++made_;
}

void LocalSceneCache::collect() {
  if (!next_.valid()) return;
  // Scans are the same in any local scene. Pictures may differ where floats decide: so the time at
  // which a local scene is taken over must not depend on the machine's speed.
  const bool ready = next_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  if (!ready && !for_pictures_) return;
  keep(next_.get());
}

void LocalSceneCache::prepare(const Eigen::Vector3d& eye_W) {
  const LocalScene* local = find(eye_W);
  if (local == nullptr || (for_pictures_ && !local->is_for_pictures())) {
    keep(make(still_instances(), eye_W.head<2>()));
    return;
  }
  for (Kept& kept : kept_) {
    if (kept.local.get() == local) kept.last_used = tick_;
  }
  if (next_.valid() || std::any_of(kept_.begin(), kept_.end(),
                                   [&](const Kept& kept) { return serves(*kept.local, eye_W); })) {
    return;
  }
  const Eigen::Vector2d way = way_from(*local, eye_W);
  const Eigen::Vector2d center = eye_W.head<2>() + kAhead * reserve_m(*local) * way.normalized();
  next_ = std::async(std::launch::async,
                     [this, still = still_instances(), center] { return make(still, center); });
}

void LocalSceneCache::prepare(const std::vector<Eigen::Vector3d>& eyes_W, bool pictures) {
  ++tick_;
  collect();
  if (pictures && !for_pictures_) {
    if (next_.valid()) keep(next_.get());  // it was started before the change
    for_pictures_ = true;
  }
  const bool any = !store_.places().empty() || (for_pictures_ && !moving_.tree().empty());
  if (options_.local_scenes && any) {
    for (const Eigen::Vector3d& eye : eyes_W) prepare(eye);
  }
  for (const Kept& kept : kept_) {
    if (kept.local->triangle_scene() != nullptr) kept.local->find_others(moving_);
  }
}

std::size_t LocalSceneCache::bytes() const {
  std::size_t sum = 0;
  for (const Kept& kept : kept_) sum += kept.local->bytes();
  return sum;
}

std::size_t LocalSceneCache::triangles() const {
  std::size_t sum = 0;
  for (const Kept& kept : kept_) sum += kept.local->triangles();
  return sum;
}

}  // namespace ardee::raycast
