// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/controllers/controller_types.h"

namespace ardee::control {

/// What becomes of a request to switch in which something cannot be done: the whole is refused, or
/// that part of it is passed over.
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

/// A controller as list_controllers has it.
struct ControllerState {
  std::string name;
  std::string type;
  std::string state;  // "initialized", "running" or "stopped"
  std::vector<Claim> claims;
};

/// What a Manager works on. All that it refers to outlives the manager.
struct ManagerContext {
  std::string robot_namespace;
  const Model& model;
  Hardware& hardware;
  SensorHandles& sensors;
  Log& log;
  std::function<Setting(const std::string& name)> parameter;
};

/// Loads, starts, stops and updates the controllers of a robot, as ros_control's
/// controller_manager. What cannot be done throws Error and changes nothing. All of it acts at
/// once, between two updates: a controller that is started has its first update in the next one.
class Manager {
 public:
  explicit Manager(ManagerContext context, const ControllerTypes& types = controller_types());
  Manager(const Manager&) = delete;
  Manager& operator=(const Manager&) = delete;
  ~Manager();

  /// Makes the controller whose parameters are at <robot_namespace>/<name>.
  Controller& load(const std::string& name);
  void unload(const std::string& name);
  /// Throws what unload would.
  void check_unload(const std::string& name) const;
  void switch_controllers(const SwitchRequest& request);
  /// Stops and unloads all that there are.
  void unload_all();

  /// In the order in which they were loaded, which is that of their updates.
  std::vector<ControllerState> list() const;
  std::vector<std::string> type_names() const;
  /// The controller of that name, or nullptr.
  Controller* find(const std::string& name) const;

  /// Lets those that run act.
  void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink);
  /// Stops those that run and starts them again.
  void restart(TimeNs now_ns);
  /// All are as they were made, and those that ran start again.
  void reset(TimeNs now_ns);

 private:
  struct Loaded;
  enum class Change { kNone, kStart, kStop };

  Loaded* find_loaded(const std::string& name) const;
  Loaded& require(const std::string& name, const std::string& failure) const;
  /// What the request makes of each controller, in the order of loading.
  std::vector<Change> plan(const SwitchRequest& request) const;
  void note(Change change, const std::vector<std::string>& names, Strictness strictness,
            std::vector<Change>& changes) const;
  void check_conflicts(const std::vector<Change>& changes) const;
  void start(Loaded& loaded);
  void stop(Loaded& loaded);

  ManagerContext context_;
  const ControllerTypes& types_;
  std::vector<std::unique_ptr<Loaded>> loaded_;
  TimeNs now_ns_ = 0;  // of the last update
};

}  // namespace ardee::control
