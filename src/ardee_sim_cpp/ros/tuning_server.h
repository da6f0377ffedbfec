// SPDX-License-Identifier: MIT
#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/node_handle.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "ardee_sim/devices/device.h"

namespace ardee::node {

/// Serves one group of a device's tunable numbers as dynamic_reconfigure does:
/// <name>/set_parameters, <name>/parameter_descriptions, <name>/parameter_updates. (Its own server
/// class needs a C++ type generated for each group at build time; ours are known when a robot is
/// spawned.)
class TuningServer {
 public:
  /// The numbers of one request, by name; a boolean is 0 or 1.
  using Values = std::vector<std::pair<std::string, double>>;

  /// Each number is set separately: one beyond its bounds is clamped, one that is not finite or
  /// unknown is ignored. `tuning` outlives the server.
  TuningServer(ros::NodeHandle& node, const devices::ParameterGroup& tuning);
  /// `set` sets all numbers of a request together, or throws Error and sets none.
  TuningServer(ros::NodeHandle& node, const devices::ParameterGroup& tuning,
               std::function<void(const Values&)> set);

  /// Publishes the numbers to subscribers. Code that changes them otherwise (a reset) need not call
  /// it: changes are looked for a few times per second.
  void publish();
  static std::string service_of(const devices::ParameterGroup& tuning) {
    return tuning.name + "/set_parameters";
  }

 private:
  dynamic_reconfigure::Config current() const;
  std::vector<double> numbers() const;
  bool serve(dynamic_reconfigure::Reconfigure::Request& request,
             dynamic_reconfigure::Reconfigure::Response& response);

  const devices::ParameterGroup& tuning_;
  std::function<void(const Values&)> set_;
  ros::Publisher descriptions_;
  ros::Publisher updates_;
  ros::ServiceServer service_;
  std::vector<double> published_;
  ros::WallTimer timer_;
};

}  // namespace ardee::node
