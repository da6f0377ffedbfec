// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <vector>

#include "ardee_sim/controllers/hardware.h"
#include "ardee_sim/controllers/hardware_sensors.h"
#include "ardee_sim/core/log.h"
#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/core/time.h"
#include "ardee_sim/description/setting.h"
#include "ardee_sim/devices/device.h"

namespace ardee::control {

/// Arguments of a controller's construction. All references outlive it.
struct ControllerContext {
  std::string name;             // "husky_velocity_controller", slashes allowed
  std::string robot_namespace;  // of the plugin, where /joint_states is: "/" or "/husky"
  const Setting& settings;      // its own parameters, below <robot_namespace>/<name>
  const Model& model;           // the robot's description: sizes that no parameter gives
  Hardware& hardware;
  SensorHandles& sensors;
  Log& log;

  /// Full name of the controller: "<robot_namespace>/<name>".
  std::string own_name() const;
  /// A topic of the controller: "<robot_namespace>/<name>/<topic>".
  std::string topic(const std::string& relative_topic) const;
  /// The handle of a joint with commands of that kind. If there is none, throws an Error that names
  /// the joint, the parameter `source` and the joints that exist.
  JointHandle& joint(const std::string& joint_name, JointInterface interface,
                     const Setting& source) const;
};

/// A controller of ros_control: while it runs, once per control period it reads joints and writes
/// the commands of those that it claims. Its construction has no effect on joints, and throws Error
/// for invalid parameters.
class Controller {
 public:
  virtual ~Controller() = default;
  Controller() = default;
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;

  /// Starts the controller: the first update comes with the next period.
  virtual void start(TimeNs /*now_ns*/) {}
  virtual void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) = 0;
  virtual void stop(TimeNs /*now_ns*/) {}
  /// Restores the state after construction, stopped, with tuned numbers as in its settings.
  virtual void reset(TimeNs now_ns) = 0;
  /// Saves or restores all that updates, commands and tunings change. Goals of actions end when a
  /// state is restored.
  virtual void serialize(StateArchive& /*state*/) {}

  /// Joints that no other running controller may command.
  const std::map<JointInterface, std::set<std::string>>& claims() const { return claims_; }
  /// Topics, services and tunings, which exist from construction until the controller is unloaded.
  /// A command that comes while it does not run is refused by the input with an Error, or forgotten
  /// at the start, as in the original controller.
  devices::Ports& ports() { return ports_; }
  bool is_running() const { return is_running_; }
  void set_running(bool is_running) { is_running_ = is_running; }

 protected:
  /// Claims a joint and returns its handle.
  JointHandle& claim(const ControllerContext& context, const std::string& joint_name,
                     JointInterface interface, const Setting& source);

 private:
  std::map<JointInterface, std::set<std::string>> claims_;
  devices::Ports ports_;
  bool is_running_ = false;
};

/// Timer of publications as in ros_controllers: due when last + 1 / rate < now, strictly; last then
/// increases by 1 / rate. A rate of 0 is never due.
class PublishTimer {
 public:
  explicit PublishTimer(double rate_hz) : rate_hz_(rate_hz) {}
  void start(TimeNs now_ns) { last_ns_ = now_ns; }
  double rate_hz() const { return rate_hz_; }
  void set_rate(double rate_hz) { rate_hz_ = rate_hz; }
  bool due(TimeNs now_ns);
  void serialize(StateArchive& state) { state(rate_hz_, last_ns_); }

 private:
  double rate_hz_;
  TimeNs last_ns_ = 0;
};

}  // namespace ardee::control
