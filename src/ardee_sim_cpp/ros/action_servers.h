// SPDX-License-Identifier: MIT
#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <vector>

#include "ardee_sim/devices/ports.h"

namespace ardee::node {

/// Serves the actions of a device or controller by actionlib, on the queue of the node: goals
/// arrive between two steps, as commands do.
class ActionServers {
 public:
  /// `ports` outlive this object. Throws Error for an invalid name.
  void add(const ros::NodeHandle& node, const devices::Ports& ports);

 private:
  std::vector<std::shared_ptr<void>> servers_;
};

}  // namespace ardee::node
