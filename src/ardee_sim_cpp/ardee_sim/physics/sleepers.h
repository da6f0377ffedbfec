// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "ardee_sim/physics/dynamic_model.h"

namespace ardee::physics {

/// Models at rest, which steps leave out until something touches them.
class Sleepers {
 public:
  /// Puts models to sleep.
  void add(const std::vector<DynamicModel*>& models);
  void remove(const DynamicModel& model);

  /// Wakes the models close to sleepers that another call has woken and perhaps moved.
  void wake_beside_woken();
  /// Wakes the models that awake models touch, and in turn the models that these touch. Returns
  /// whether it woke any.
  bool wake_touched(std::vector<DynamicModel*> awake);
  /// Wakes the models whose bounds come close to a box.
  void wake_near(const Eigen::AlignedBox3d& box);
  void wake_all();
  /// Saves or restores the sleepers among `models`.
  void serialize(StateArchive& state, const std::vector<std::unique_ptr<DynamicModel>>& models);

 private:
  struct Sleeper {
    Eigen::AlignedBox3d bounds;
    DynamicModel* model;
  };
  void forget_awake();
  /// Calls a function with each sleeper whose bounds meet a box.
  template <typename Function>
  void for_each_in(const Eigen::AlignedBox3d& box, const Function& function) const;

  std::vector<Sleeper> sleepers_;  // in the order of their lower x
  double widest_m_ = 0.0;          // along x
  std::uint64_t rests_ = 0;
};

}  // namespace ardee::physics
