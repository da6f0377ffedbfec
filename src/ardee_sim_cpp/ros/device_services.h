// SPDX-License-Identifier: MIT
#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/devices/ports.h"
#include "ros/service_servers.h"
#include "ros/tuning_server.h"

namespace ardee::node {

/// Whether this node has no service of that name yet.
bool is_free_service(const std::string& name);

/// Services and tunings of devices or controllers.
class DeviceServices {
 public:
  explicit DeviceServices(const ros::NodeHandle& node) : node_(node), servers_(node) {}

  /// Throws Error for an invalid name.
  void add(const devices::Service& service);
  /// `tuning` outlives this object.
  void add(const devices::ParameterGroup& tuning);
  /// Names of services that were not added because they are taken.
  const std::vector<std::string>& taken() const { return taken_; }

 private:
  bool is_free(const std::string& name);

  ros::NodeHandle node_;
  ServiceServers servers_;
  std::vector<std::unique_ptr<TuningServer>> tunings_;
  std::vector<std::string> taken_;
};

}  // namespace ardee::node
