// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/controllers/controller_types.h"

namespace ardee::control {

/// Policy for a request to switch of which a part is impossible: refuse the whole request, or skip
/// that part.
enum class Strictness { kStrict, kBestEffort };

struct SwitchRequest {
  std::vector<std::string> start;
  std::vector<std::string> stop;
  Strictness strictness = Strictness::kBestEffort;
};

/// The joints that a controller claims by one interface, by name.
struct Claim {
  std::string interface;  // "hardware_interface::VelocityJointInterface"
  std::vector<std::string> joints;
};

/// A controller as in list_controllers.
struct ControllerState {
  std::string name;
  std::string type;
  std::string state;  // "initialized", "running" or "stopped"
  std::vector<Claim> claims;
};

/// Arguments of a Manager's construction. All references outlive the manager.
struct ManagerContext {
  std::string robot_namespace;
  const Model& model;
  Hardware& hardware;
  SensorHandles& sensors;
  Log& log;
  std::function<Setting(const std::string& name)> parameter;
};

/// Loads, starts, stops and updates the controllers of a robot, as ros_control's controller_manager
/// does. A call that cannot be carried out throws Error and changes nothing. All calls act at once,
/// between two updates: a started controller has its first update in the next one.
class Manager {
 public:
  explicit Manager(ManagerContext context, const ControllerTypes& types = controller_types());
  Manager(const Manager&) = delete;
  Manager& operator=(const Manager&) = delete;
  ~Manager();

  /// Makes the controller whose parameters are at <robot_namespace>/<name>.
  Controller& load(const std::string& name);
  void unload(const std::string& name);
  /// Throws the Error that unload would throw.
  void check_unload(const std::string& name) const;
  void switch_controllers(const SwitchRequest& request);
  /// Stops and unloads all controllers.
  void unload_all();

  /// States of the controllers in the order of loading, which is that of their updates.
  std::vector<ControllerState> list() const;
  std::vector<std::string> type_names() const;
  /// The controller of that name, or nullptr.
  Controller* find(const std::string& name) const;

  /// Updates the running controllers.
  void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink);
  /// Stops the running controllers and starts them again.
  void restart(TimeNs now_ns);
  /// Restores all controllers to their state after construction, and restarts those that ran.
  void reset(TimeNs now_ns);
  /// Saves or restores the loaded controllers with their states. Throws Error if one that was
  /// loaded then cannot be loaded now.
  void serialize(StateArchive& state);

 private:
  struct Loaded;
  enum class Change { kNone, kStart, kStop };

  Loaded* find_loaded(const std::string& name) const;
  Loaded& require(const std::string& name, const std::string& failure) const;
  /// The change of each controller by the request, in the order of loading.
  std::vector<Change> plan(const SwitchRequest& request) const;
  void note(Change change, const std::vector<std::string>& names, Strictness strictness,
            std::vector<Change>& changes) const;
  void check_conflicts(const std::vector<Change>& changes) const;
  /// Loads and unloads controllers so that these are there, in this order.
  void load_only(const std::vector<std::string>& names);
  void start(Loaded& loaded);
  void stop(Loaded& loaded);

  ManagerContext context_;
  const ControllerTypes& types_;
  std::vector<std::unique_ptr<Loaded>> loaded_;
  TimeNs now_ns_ = 0;  // of the last update
};

}  // namespace ardee::control
