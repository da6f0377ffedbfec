// SPDX-License-Identifier: MIT
#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <vector>

#include "ardee_sim/devices/actions.h"

namespace ardee::node {

/// Serves actions of devices or controllers by actionlib, on the queue of the node: goals
/// arrive between two steps, as commands do.
class ActionServers {
 public:
  /// `action` outlives this object. Throws Error for an invalid name.
  void add(const ros::NodeHandle& node, const devices::Action& action);

 private:
  std::vector<std::shared_ptr<void>> servers_;
};

}  // namespace ardee::node
