// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/fixed_scenery.h"

#include <algorithm>

#include "ardee_sim/raycast/local_scene.h"

namespace ardee::raycast {
namespace {

/// Radius above which a body is tested for each ray: in the tree it would coarsen the floats of all
/// others.
constexpr double kHugeRadius_m = 2000.0;
/// Distance from the wished centre, as a share of half the side, within which a local scene serves
/// scans: so little that a sensor does not ask for the next one at once.
constexpr double kNearShare = 0.05;

bool is_huge(const TraceableInstance& placed) {
  return placed.body->bounds.radius() * placed.scale > kHugeRadius_m;
}

bool are_equal(const TraceableInstance& a, const TraceableInstance& b) {
  return a.body == b.body && a.p == b.p && a.q.coeffs() == b.q.coeffs() && a.scale == b.scale &&
         a.entity == b.entity && a.label == b.label;
}

bool are_equal(const std::shared_ptr<const SceneryGroup>& a,
               const std::shared_ptr<const SceneryGroup>& b) {
  return a == b ||
         (a->first_entity == b->first_entity && a->count == b->count &&
          std::equal(a->placed.begin(), a->placed.end(), b->placed.begin(), b->placed.end(),
                     [](const auto& x, const auto& y) { return are_equal(x, y); }));
}

bool serves(const LocalScene& scene, const LocalSceneRequest& made,
            const LocalSceneRequest& wanted) {
  if (made.half_size_m != wanted.half_size_m || made.budget.entries != wanted.budget.entries ||
      made.budget.triangle_bytes != wanted.budget.triangle_bytes) {
    return false;
  }
  if (made.center_W == wanted.center_W) return true;
  const double off_m = (made.center_W - wanted.center_W).cwiseAbs().maxCoeff();
  const double most_m = scene.half_size_m() * (scene.holds_all() ? 1.0 : kNearShare);
  return !scene.is_for_pictures() && off_m < most_m;
}

template <typename Entry, typename Weak>
void forget_expired(std::vector<Entry>& entries, Weak weak) {
  entries.erase(std::remove_if(entries.begin(), entries.end(),
                               [&](const Entry& entry) { return weak(entry).expired(); }),
                entries.end());
}

}  // namespace

FixedScenery::FixedScenery(Groups groups) : groups_(std::move(groups)) {
  std::vector<const TraceableInstance*> places;
  for (const auto& group : groups_) {
    for (const TraceableInstance& placed : group->placed) {
      if (is_huge(placed) || !placed.body->grounds.empty()) unbounded_.push_back(&placed);
      if (!is_huge(placed) && !placed.body->primitives.empty()) places.push_back(&placed);
    }
  }
  places_.build(std::move(places), BuildQuality::kMedium);
}

std::shared_ptr<const FixedScenery> FixedScenery::of(Groups groups) {
  static std::mutex mutex;
  static std::vector<std::weak_ptr<const FixedScenery>> known;
  const std::lock_guard<std::mutex> lock(mutex);
  forget_expired(known, [](const auto& entry) { return entry; });
  for (const auto& entry : known) {
    auto scenery = entry.lock();
    if (scenery != nullptr &&
        std::equal(groups.begin(), groups.end(), scenery->groups_.begin(), scenery->groups_.end(),
                   [](const auto& a, const auto& b) { return are_equal(a, b); })) {
      return scenery;
    }
  }
  std::shared_ptr<const FixedScenery> made(new FixedScenery(std::move(groups)));
  known.push_back(made);
  return made;
}

void FixedScenery::intersect_unbounded(RayQuery& query) const {
  for (const TraceableInstance* placed : unbounded_) {
    query.enter(*placed);
    for (const std::uint32_t ground : placed->body->grounds) {
      query.intersect_solid(placed->body->solids[ground]);
    }
    if (is_huge(*placed)) query.intersect_traceable(*placed, 0.0);
  }
}

std::shared_ptr<const LocalScene> FixedScenery::local_scene(
    const LocalSceneRequest& request) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  forget_expired(local_scenes_, [](const Kept& kept) { return kept.scene; });
  for (const Kept& kept : local_scenes_) {
    auto scene = kept.scene.lock();
    if (scene != nullptr && serves(*scene, kept.request, request)) return scene;
  }
  auto made = std::make_shared<const LocalScene>(shared_from_this(), StillInstances{}, request);
  local_scenes_.push_back({request, made});
  return made;
}

}  // namespace ardee::raycast
