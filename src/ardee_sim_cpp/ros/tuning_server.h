// SPDX-License-Identifier: MIT
#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/node_handle.h>

#include <string>

#include "ardee_sim/devices/device.h"

namespace ardee::node {

/// Serves one group of a device's tunable numbers as dynamic_reconfigure does:
/// <name>/set_parameters, <name>/parameter_descriptions, <name>/parameter_updates. (Its own server
/// class needs a C++ type generated for each group at build time; ours are known when a robot is
/// spawned.)
class TuningServer {
 public:
  /// `tuning` outlives the server.
  TuningServer(ros::NodeHandle& node, const Tuning& tuning);
  static std::string service_of(const Tuning& tuning) { return tuning.name + "/set_parameters"; }

 private:
  dynamic_reconfigure::Config current() const;
  bool set(dynamic_reconfigure::Reconfigure::Request& request,
           dynamic_reconfigure::Reconfigure::Response& response);

  const Tuning& tuning_;
  ros::Publisher descriptions_;
  ros::Publisher updates_;
  ros::ServiceServer service_;
};

}  // namespace ardee::node
