// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <vector>

#include "ardee_sim/controllers/hardware.h"
#include "ardee_sim/controllers/hardware_sensors.h"
#include "ardee_sim/core/log.h"
#include "ardee_sim/core/time.h"
#include "ardee_sim/description/setting.h"
#include "ardee_sim/devices/device.h"

namespace ardee::control {

/// What a controller is made with. All references outlive it.
struct ControllerContext {
  std::string name;             // "husky_velocity_controller", slashes allowed
  std::string robot_namespace;  // of the plugin, where /joint_states is: "/" or "/husky"
  const Setting& settings;      // its own parameters, below <robot_namespace>/<name>
  const Model& model;           // the robot's description: sizes that no parameter says
  Hardware& hardware;
  SensorHandles& sensors;
  Log& log;

  /// Its name in full: "<robot_namespace>/<name>".
  std::string own_name() const;
  /// A topic of the controller: "<robot_namespace>/<name>/<topic>".
  std::string topic(const std::string& relative_topic) const;
  /// The handle of a joint with commands of that kind. Throws Error that names the joint, what the
  /// parameter `source` says, and what there is, if there is none.
  JointHandle& joint(const std::string& joint_name, JointInterface interface,
                     const Setting& source) const;
};

/// A law of ros_control: reads joints, writes commands of those that it claims, once a control
/// period while it runs. Made without any effect on joints; what it is made with wrongly throws
/// Error.
class Controller {
 public:
  virtual ~Controller() = default;
  Controller() = default;
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;

  /// Begins to run: the first update comes with the next period.
  virtual void start(TimeNs /*now_ns*/) {}
  virtual void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) = 0;
  virtual void stop(TimeNs /*now_ns*/) {}
  /// State as when it was made, stopped; tuned numbers as in its settings.
  virtual void reset(TimeNs now_ns) = 0;

  /// Joints that no other running controller may command.
  const std::map<JointInterface, std::set<std::string>>& claims() const { return claims_; }
  /// Topics, services and tunings, there from when it is made until it is unloaded. Commands that
  /// come while it does not run are refused by its inputs with an Error or forgotten at its start,
  /// as its original does.
  devices::Ports& ports() { return ports_; }
  bool is_running() const { return is_running_; }
  void set_running(bool is_running) { is_running_ = is_running; }

 protected:
  /// The handle, claimed.
  JointHandle& claim(const ControllerContext& context, const std::string& joint_name,
                     JointInterface interface, const Setting& source);

 private:
  std::map<JointInterface, std::set<std::string>> claims_;
  devices::Ports ports_;
  bool is_running_ = false;
};

/// Publishes at a rate as ros_controllers do: when last + 1 / rate < now, strictly, and then last
/// moves on by 1 / rate. A rate of 0 publishes never.
class PublishTimer {
 public:
  explicit PublishTimer(double rate_hz) : rate_hz_(rate_hz) {}
  void start(TimeNs now_ns) { last_ns_ = now_ns; }
  double rate_hz() const { return rate_hz_; }
  void set_rate(double rate_hz) { rate_hz_ = rate_hz; }
  bool due(TimeNs now_ns);

 private:
  double rate_hz_;
  TimeNs last_ns_ = 0;
};

}  // namespace ardee::control
