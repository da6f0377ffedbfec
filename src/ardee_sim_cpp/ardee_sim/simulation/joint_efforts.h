// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/core/time.h"
#include "ardee_sim/devices/robot.h"

namespace ardee {

/// An effort (N m or N) along a joint's first axis for a limited time.
struct JointEffort {
  devices::Robot* robot = nullptr;
  std::size_t joint = 0;
  double effort = 0.0;
  TimeNs start_ns = 0;
  TimeNs duration_ns = 0;  // negative: until cleared
};

/// The efforts in force; several on one joint add up.
class JointEfforts {
 public:
  void add(const JointEffort& effort) { efforts_.push_back(effort); }
  void clear(const devices::Robot& robot, std::size_t joint);
  void clear(const devices::Robot& robot);
  void clear_all() { efforts_.clear(); }
  /// Applies the efforts in force at `now_ns` and removes expired ones.
  void apply(TimeNs now_ns);
  /// Saves or restores them; `robot_of` finds a robot by its number.
  void serialize(StateArchive& state,
                 const std::function<devices::Robot*(std::uint32_t)>& robot_of);

 private:
  std::vector<JointEffort> efforts_;
};

}  // namespace ardee
