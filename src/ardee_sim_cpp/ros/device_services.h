// SPDX-License-Identifier: MIT
#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <vector>

#include "ardee_sim/devices/device.h"
#include "ros/service_servers.h"
#include "ros/tuning_server.h"

namespace ardee::node {

/// What the devices of one robot do on request: services, triggers and tunings.
class DeviceServices {
 public:
  explicit DeviceServices(const ros::NodeHandle& node) : node_(node), servers_(node) {}

  /// `device` outlives this object.
  void add(const Device& device);

 private:
  void add(const Service& service);

  ros::NodeHandle node_;
  ServiceServers servers_;
  std::vector<std::unique_ptr<TuningServer>> tunings_;
};

}  // namespace ardee::node
