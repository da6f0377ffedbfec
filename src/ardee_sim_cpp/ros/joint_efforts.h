// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "ardee_sim/simulation/simulation.h"

namespace ardee::node {

/// An effort (N m or N) along a joint's axis for a while.
struct JointEffort {
  std::string model;
  std::size_t joint = 0;
  double effort = 0.0;
  TimeNs start_ns = 0;
  TimeNs duration_ns = 0;  // negative: until cleared
};

/// The efforts in force; several on one joint add up.
class JointEfforts {
 public:
  void add(const JointEffort& effort) { efforts_.push_back(effort); }
  void clear(const std::string& model, std::size_t joint);
  void clear_model(const std::string& model);
  void clear_all() { efforts_.clear(); }
  /// Before a step: applies those in force and forgets those that are over.
  void apply(Simulation& simulation);

 private:
  std::vector<JointEffort> efforts_;
};

}  // namespace ardee::node
