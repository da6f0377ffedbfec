// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/scenery.h"
#include "ardee_sim/raycast/fixed_scenery.h"
#include "ardee_sim/raycast/scene_kind.h"

namespace ardee::raycast {

/// The fixed bodies of one simulation, which come and go: each description compiled once, each
/// place a few numbers.
class SceneryStore {
 public:
  SceneryStore(SceneKind kind, Log& log) : kind_(kind), log_(log) { commit(); }

  /// Throws Error and adds nothing if a placement is invalid.
  void add(std::uint32_t first_entity, const std::vector<Placement>& placements);
  void remove(std::uint32_t first_entity);
  /// Makes the scenery of what was added, or finds that of another simulation.
  void commit();
  bool committed() const { return fixed_ != nullptr; }
  /// The scenery since the last commit.
  const std::shared_ptr<const FixedScenery>& fixed() const { return fixed_; }

 private:
  void check(std::uint32_t first_entity, const std::vector<Placement>& placements) const;

  SceneKind kind_;
  Log& log_;
  std::map<std::uint32_t, std::shared_ptr<const SceneryGroup>> groups_;
  std::shared_ptr<const FixedScenery> fixed_;
};

}  // namespace ardee::raycast
