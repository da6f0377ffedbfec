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

bool have_equal_limits(const LocalSceneRequest& a, const LocalSceneRequest& b) {
  return a.half_size_m == b.half_size_m && a.budget.entries == b.budget.entries &&
         a.budget.triangle_bytes == b.budget.triangle_bytes;
}

bool are_equal(const LocalSceneRequest& a, const LocalSceneRequest& b) {
  return a.center_W == b.center_W && have_equal_limits(a, b);
}

bool serves(const LocalScene& scene, const LocalSceneRequest& made,
            const LocalSceneRequest& wanted) {
  if (scene.is_for_pictures()) return are_equal(made, wanted);
  const double off_m = (made.center_W - wanted.center_W).cwiseAbs().maxCoeff();
  const double most_m = scene.half_size_m() * (scene.holds_all() ? 1.0 : kNearShare);
  return have_equal_limits(made, wanted) && off_m < most_m;
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
  known.erase(
      std::remove_if(known.begin(), known.end(), [](const auto& entry) { return entry.expired(); }),
      known.end());
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

std::shared_ptr<const LocalScene> FixedScenery::find(const LocalSceneRequest& request,
                                                     std::shared_ptr<Slot>& slot) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  slots_.erase(std::remove_if(slots_.begin(), slots_.end(),
                              [](const auto& each) {  // nobody makes it or uses it
                                return each.use_count() == 1 && each->scene.expired();
                              }),
               slots_.end());
  for (const auto& each : slots_) {
    auto scene = each->scene.lock();
    if (scene != nullptr && serves(*scene, each->request, request)) return scene;
  }
  const auto found = std::find_if(slots_.begin(), slots_.end(), [&](const auto& each) {
    return are_equal(each->request, request);
  });
  if (found != slots_.end()) {
    slot = *found;
  } else {
    slot = std::make_shared<Slot>();
    slot->request = request;
    slots_.push_back(slot);
  }
  return nullptr;
}

std::shared_ptr<const LocalScene> FixedScenery::local_scene(
    const LocalSceneRequest& request) const {
  std::shared_ptr<Slot> slot;
  if (auto scene = find(request, slot)) return scene;
  const std::lock_guard<std::mutex> making(slot->making);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (auto scene = slot->scene.lock()) return scene;  // another thread has just made it
  }
  auto made = std::make_shared<const LocalScene>(shared_from_this(), StillInstances{}, request);
  const std::lock_guard<std::mutex> lock(mutex_);
  slot->scene = made;
  return made;
}

}  // namespace ardee::raycast
