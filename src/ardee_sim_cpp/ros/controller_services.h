// SPDX-License-Identifier: MIT
#pragma once

#include <ros/node_handle.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/controllers/ros_control.h"
#include "ros/port_topics.h"
#include "ros/service_servers.h"

namespace ardee::node {

/// The services of a robot's controller manager, as ros_control's: list_controllers,
/// load_controller, unload_controller, switch_controller, list_controller_types and
/// reload_controller_libraries below <robot_namespace>/controller_manager; and the topics of the
/// controllers, which exist as long as their controllers. A switch acts at once, between two steps,
/// also while the physics is paused; `timeout` and `start_asap` have no effect.
class ControllerServices {
 public:
  /// All references outlive this object.
  ControllerServices(const ros::NodeHandle& node, control::RosControl& device,
                     const devices::Robot& robot, Routes& routes, Log log);

  /// Names of services that were not advertised because they are taken.
  const std::vector<std::string>& taken() const { return taken_; }

 private:
  template <typename Service, typename Act>
  void serve(const std::string& name, Act act);
  /// Carries out a request and returns whether it succeeded; a thrown Error goes to the log.
  template <typename Act>
  bool attempt(Act act);

  void load(const std::string& name);
  void unload(const std::string& name);
  void switch_controllers(control::SwitchRequest request, int strictness);
  void reload(bool force_kill);

  ros::NodeHandle node_;
  control::Manager& manager_;
  std::string space_;
  const devices::Robot& robot_;
  Routes& routes_;
  Log log_;
  std::map<std::string, std::unique_ptr<PortTopics>> topics_;  // by controller
  ServiceServers servers_;
  std::vector<std::string> taken_;
};

}  // namespace ardee::node
