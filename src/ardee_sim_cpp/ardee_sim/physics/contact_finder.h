// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "ardee_sim/physics/contact_joints.h"
#include "ardee_sim/physics/dynamic_model.h"
#include "ardee_sim/physics/scenery_index.h"
#include "ardee_sim/physics/solver.h"

namespace ardee::physics {

/// Finds the contacts of a step: each model against the scenery near it, itself and the other
/// models, always in the order in which the models are given.
class ContactFinder {
 public:
  ContactFinder(SceneryIndex& scenery, ContactJoints& contacts)
      : scenery_(scenery), contacts_(contacts) {}

  /// Finds the contacts of the awake models in a step.
  void find(const std::vector<DynamicModel*>& models, const PhysicsParams& params);

  /// Groups of models that touch one another and are solved together, in the order of the models.
  std::vector<Island> islands();
  /// Models of islands that stand on scenery, none of which has a sensor, and are wholly at rest.
  std::vector<DynamicModel*> at_rest();

 private:
  /// A model's shapes as they stand before the step.
  struct Moving {
    DynamicModel* model;
    std::vector<Eigen::AlignedBox3d> bounds;
    Eigen::AlignedBox3d all;
    std::size_t rows;
    bool on_scenery;
    bool is_felt;        // touches scenery that has sensors
    std::size_t island;  // index of a model of the same island, its own at the root
  };

  void gather(const std::vector<DynamicModel*>& models);
  void pair_up();
  void touch_scenery(Moving& item, const PhysicsParams& params);
  void touch_self(Moving& item, const PhysicsParams& params);
  void touch(std::size_t first, std::size_t second, const PhysicsParams& params);
  std::size_t island_of(std::size_t index);

  SceneryIndex& scenery_;
  ContactJoints& contacts_;
  std::vector<Moving> moving_;
  std::vector<std::size_t> by_x_;                           // of moving_, by lower bound
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;  // whose bounds meet, in order
  std::vector<const CollisionShape*> near_;
};

}  // namespace ardee::physics
