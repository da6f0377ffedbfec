// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/near_regions.h"

#include <algorithm>
#include <chrono>

namespace ardee {
namespace {

/// One region may take this share of the budget, so that several robots find room.
constexpr std::size_t kBudgetShare = 4;
/// The square reaches this much further than the radius asked for (as a share of it), so that it
/// lasts for a while.
constexpr double kSpareShare = 0.5;
/// Where pictures are taken, the square reaches so far, if the budget allows.
constexpr double kPictureRadius_m = 12.0;
/// The next region's centre lies so far ahead of the sensor, as a share of the way from a centre
/// that a sensor may go: less than 1, so that one that turns back is still within it.
constexpr double kAhead = 0.75;
/// Regions that no sensor was in for so many calls make room.
constexpr std::uint64_t kIdleCalls = 2000;

Eigen::Vector2d way_from(const NearRegion& region, const Eigen::Vector3d& eye_W) {
  return eye_W.head<2>() - region.center_W();
}

/// How far a sensor may be from the centre without another region being made.
double reserve_m(const NearRegion& region) {
  return region.half_size_m() * (kSpareShare / (1.0 + kSpareShare));
}

}  // namespace

double NearRegions::slack_m() const { return kSpareShare * options_.flattened_radius_m; }

std::unique_ptr<NearRegion> NearRegions::make(const StillBodies& still,
                                              const Eigen::Vector2d& center_W) const {
  RegionBudget budget{options_.flattened_budget_bytes / kBudgetShare};
  double radius_m = options_.flattened_radius_m;
  if (drafts_) {
    // A picture sees farther than a scan, but the triangles take the most room.
    radius_m = std::max(radius_m, kPictureRadius_m);
    budget.draft = options_.flattened_budget_bytes / 2;
  }
  return std::make_unique<NearRegion>(device_, store_, still, center_W, radius_m + slack_m(),
                                      budget);
}

/// Pictures alone take them for scenery.
StillBodies NearRegions::still_bodies() const {
  return drafts_ ? moving_.still_bodies() : StillBodies{};
}

bool NearRegions::serves(const NearRegion& region, const Eigen::Vector3d& eye_W) const {
  if (drafts_ && (!region.is_for_pictures() || region.is_outdated())) return false;
  return region.holds_all() || way_from(region, eye_W).norm() <= reserve_m(region);
}

void NearRegions::clear() {
  if (next_.valid()) next_.wait();
  next_ = {};
  kept_.clear();
}

const NearRegion* NearRegions::find(const Eigen::Vector3d& eye_W) const {
  const NearRegion* best = nullptr;
  double depth_m = 0.0;
  for (const Kept& kept : kept_) {
    if (kept.region->depth_m(eye_W) > depth_m) {
      depth_m = kept.region->depth_m(eye_W);
      best = kept.region.get();
    }
  }
  return best;
}

void NearRegions::keep(std::unique_ptr<NearRegion> region) {
  // What a new region makes superfluous goes: the ones about it, idle ones, then the longest
  // unused.
  const double close_m = 2.0 * slack_m() + 1e-6;
  std::size_t total = region->bytes();
  std::sort(kept_.begin(), kept_.end(),
            [](const Kept& a, const Kept& b) { return a.last_used > b.last_used; });
  std::vector<Kept> still;
  for (Kept& kept : kept_) {
    const bool near =
        (kept.region->center_W() - region->center_W()).cwiseAbs().maxCoeff() <= close_m;
    const bool idle = kept.last_used + kIdleCalls < tick_;
    total += kept.region->bytes();
    if (!near && !idle && total <= options_.flattened_budget_bytes)
      still.push_back(std::move(kept));
  }
  kept_ = std::move(still);
  kept_.push_back({std::move(region), tick_});
  ++made_;
}

void NearRegions::collect() {
  if (!next_.valid()) return;
  // Scans are the same in any region. Pictures are not quite, where floats decide: there the time
  // at which a region comes must not depend on how fast the machine is.
  const bool ready = next_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  if (!ready && !drafts_) return;
  keep(next_.get());
}

void NearRegions::prepare(const Eigen::Vector3d& eye_W) {
  const NearRegion* region = find(eye_W);
  if (region == nullptr || (drafts_ && !region->is_for_pictures())) {
    keep(make(still_bodies(), eye_W.head<2>()));
    return;
  }
  for (Kept& kept : kept_) {
    if (kept.region.get() == region) kept.last_used = tick_;
  }
  if (next_.valid() || std::any_of(kept_.begin(), kept_.end(),
                                   [&](const Kept& kept) { return serves(*kept.region, eye_W); })) {
    return;
  }
  const Eigen::Vector2d way = way_from(*region, eye_W);
  const Eigen::Vector2d center = eye_W.head<2>() + kAhead * reserve_m(*region) * way.normalized();
  next_ = std::async(std::launch::async,
                     [this, still = still_bodies(), center] { return make(still, center); });
}

void NearRegions::prepare(const std::vector<Eigen::Vector3d>& eyes_W, bool drafts) {
  ++tick_;
  collect();
  if (drafts && !drafts_) {
    if (next_.valid()) keep(next_.get());  // it is being made without
    drafts_ = true;
  }
  const bool any = !store_.places().empty() || (drafts_ && !moving_.tree().empty());
  if (options_.flatten && any) {
    for (const Eigen::Vector3d& eye : eyes_W) prepare(eye);
  }
  for (const Kept& kept : kept_) {
    if (kept.region->draft() != nullptr) kept.region->find_others(moving_);
  }
}

std::size_t NearRegions::bytes() const {
  std::size_t sum = 0;
  for (const Kept& kept : kept_) sum += kept.region->bytes();
  return sum;
}

std::size_t NearRegions::triangles() const {
  std::size_t sum = 0;
  for (const Kept& kept : kept_) sum += kept.region->triangles();
  return sum;
}

}  // namespace ardee
