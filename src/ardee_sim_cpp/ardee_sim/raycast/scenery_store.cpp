// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/scenery_store.h"

#include <algorithm>
#include <cmath>

#include "ardee_sim/raycast/traceable_compiler.h"

namespace ardee::raycast {
namespace {

/// Greatest coordinate: farther away, Embree's floats would be whole metres.
constexpr double kFarthest_m = 1e7;

}  // namespace

void SceneryStore::check(std::uint32_t first_entity,
                         const std::vector<Placement>& placements) const {
  const std::uint64_t end = static_cast<std::uint64_t>(first_entity) + placements.size();
  for (const auto& [first, group] : groups_) {
    if (first < end && first_entity < static_cast<std::uint64_t>(first) + group->count) {
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

void SceneryStore::add(std::uint32_t first_entity, const std::vector<Placement>& placements) {
  check(first_entity, placements);
  auto group = std::make_shared<SceneryGroup>();
  group->first_entity = first_entity;
  group->count = placements.size();
  group->placed.reserve(placements.size());
  std::map<const Model*, const Traceable*> known;
  std::uint32_t entity = first_entity;
  for (const Placement& placement : placements) {
    const auto [entry, is_new] = known.try_emplace(placement.model.get(), nullptr);
    if (is_new) {
      group->bodies.push_back(compile_model(placement.model, kind_, log_));
      entry->second = group->bodies.back().get();
    }
    group->placed.push_back({entry->second, placement.X_WM.p, placement.X_WM.q, placement.scale,
                             entity++, placement.label});
  }
  groups_.emplace(first_entity, std::move(group));
  fixed_.reset();
}

void SceneryStore::remove(std::uint32_t first_entity) {
  if (groups_.erase(first_entity) == 0) {
    throw Error("there is no scenery " + std::to_string(first_entity) + " to remove");
  }
  fixed_.reset();
}

void SceneryStore::commit() {
  FixedScenery::Groups groups;
  for (const auto& [first, group] : groups_) groups.push_back(group);
  fixed_ = FixedScenery::of(std::move(groups));
  for (const auto& group : fixed_->groups()) groups_[group->first_entity] = group;
}

}  // namespace ardee::raycast
