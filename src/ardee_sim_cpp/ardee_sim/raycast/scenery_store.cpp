// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/scenery_store.h"

#include <algorithm>
#include <cmath>

#include "ardee_sim/raycast/traceable_compiler.h"

namespace ardee::raycast {
namespace {

/// Radius above which a body is tested for each ray: in the tree it would coarsen the floats of all
/// others.
constexpr double kHugeRadius_m = 2000.0;
/// Greatest coordinate: farther away, Embree's floats would be whole metres.
constexpr double kFarthest_m = 1e7;

}  // namespace

void SceneryStore::check(std::uint32_t first_entity,
                         const std::vector<Placement>& placements) const {
  const std::uint64_t end = static_cast<std::uint64_t>(first_entity) + placements.size();
  for (const auto& [first, group] : groups_) {
    if (first < end && first_entity < static_cast<std::uint64_t>(first) + group.count) {
      throw Error("scenery " + std::to_string(first_entity) +
                  ": its entities are in use by scenery " + std::to_string(first));
    }
  }
  for (const Placement& placement : placements) {
    if (placement.model == nullptr) throw Error("scenery: a placement has no model");
    const std::string name = "scenery '" + placement.model->name + "': ";
    if (!placement.X_WM.is_finite()) throw Error(name + "its pose is not finite");
    if (placement.X_WM.p.cwiseAbs().maxCoeff() > kFarthest_m) {
      throw Error(name + "it lies more than 1e7 m from the origin");
    }
    if (std::abs(placement.X_WM.q.norm() - 1.0) > 1e-6) {
      throw Error(name + "its rotation is not a unit quaternion");
    }
    if (!std::isfinite(placement.scale) || placement.scale <= 0.0) {
      throw Error(name + "its scale must be finite and above 0");
    }
  }
}

const Traceable* SceneryStore::use_body(const std::shared_ptr<const Model>& model, Group& group) {
  Compiled& compiled = bodies_[model.get()];
  if (compiled.body == nullptr) {
    try {
      compiled.body = compile_model(device_, masks_, *model, kind_);
    } catch (...) {
      bodies_.erase(model.get());
      throw;
    }
    compiled.model = model;
  }
  group.models.push_back(model.get());
  ++compiled.uses;
  return compiled.body.get();
}

void SceneryStore::add(std::uint32_t first_entity, const std::vector<Placement>& placements) {
  check(first_entity, placements);
  Group group;
  group.count = placements.size();
  group.placed.reserve(placements.size());
  std::map<const Model*, const Traceable*> known;
  try {
    std::uint32_t entity = first_entity;
    for (const Placement& placement : placements) {
      const auto [entry, is_new] = known.try_emplace(placement.model.get(), nullptr);
      if (is_new) entry->second = use_body(placement.model, group);
      group.placed.push_back({entry->second, placement.X_WM.p, placement.X_WM.q, placement.scale,
                              entity++, placement.label});
    }
  } catch (...) {
    release(group);
    throw;
  }
  groups_.emplace(first_entity, std::move(group));
  committed_ = false;
}

void SceneryStore::release(const Group& group) {
  for (const Model* model : group.models) {
    const auto compiled = bodies_.find(model);
    if (--compiled->second.uses == 0) bodies_.erase(compiled);
  }
}

void SceneryStore::remove(std::uint32_t first_entity) {
  const auto group = groups_.find(first_entity);
  if (group == groups_.end()) {
    throw Error("there is no scenery " + std::to_string(first_entity) + " to remove");
  }
  committed_ = false;
  places_.clear();
  unbounded_.clear();
  release(group->second);
  groups_.erase(group);
}

void SceneryStore::commit() {
  unbounded_.clear();
  std::vector<const TraceableInstance*> places;
  for (const auto& [first, group] : groups_) {
    for (const TraceableInstance& placed : group.placed) {
      const Traceable& body = *placed.body;
      const bool huge = body.bounds.radius() * placed.scale > kHugeRadius_m;
      if (huge || !body.grounds.empty()) unbounded_.push_back(&placed);
      if (!huge && !body.primitives.empty()) places.push_back(&placed);
    }
  }
  places_.build(device_, std::move(places), BuildQuality::kMedium);
  committed_ = true;
}

void SceneryStore::intersect_unbounded(RayQuery& query) const {
  for (const TraceableInstance* placed : unbounded_) {
    query.enter(*placed);
    for (const std::uint32_t ground : placed->body->grounds) {
      query.intersect_solid(placed->body->solids[ground]);
    }
    if (placed->body->bounds.radius() * placed->scale > kHugeRadius_m) {
      query.intersect_traceable(*placed, 0.0);
    }
  }
}

}  // namespace ardee::raycast
