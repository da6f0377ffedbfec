// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ardee_sim/controllers/hardware_sensors.h"
#include "ardee_sim/controllers/joint_actuator.h"
#include "ardee_sim/controllers/manager.h"
#include "ardee_sim/controllers/steer_bot.h"
#include "ardee_sim/devices/registry.h"

namespace ardee::control {

/// libgazebo_ros_control.so with its DefaultRobotHWSim, the joints that the robot's transmissions
/// name, or with a SteerBot, as the hardware of a controller manager. Each control period reads the
/// joints and updates the controllers; each step applies their commands.
class RosControl : public devices::Device {
 public:
  struct Params {
    std::string robot_namespace;
    TimeNs period_ns = 0;
    std::string stop_topic;  // empty: none
    bool has_legacy_gains = false;
    bool is_steer_bot = false;
  };

  /// Returns nothing, with an error in the log, if the robot's transmissions lack what the original
  /// plugin requires: the robot exists, but without actuation.
  static std::unique_ptr<devices::Device> make(const PluginDescription& plugin,
                                               Parameters& parameters,
                                               devices::DeviceContext& context);
  /// Throws Error if a joint of the transmissions does not exist, or its interface is unknown.
  RosControl(const PluginDescription& plugin, const Params& params,
             devices::DeviceContext& context);

  Manager& manager() { return *manager_; }
  const std::string& robot_namespace() const { return params_.robot_namespace; }

  void before_step(TimeNs now_ns) override;
  void observe(TimeNs now_ns) override { sensors_.begin_step(now_ns); }
  void on_set_state() override { sensors_.on_set_state(); }
  /// Gives the readings that the controllers made before the step.
  void after_step(TimeNs now_ns, devices::ReadingSink& sink) override;
  /// Sets all joint commands to 0 and restarts the running controllers.
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override {
    state(is_stopped_, was_stopped_, last_control_ns_, last_write_ns_, sensors_);
    for (auto& [name, handle] : hardware_) state(handle);
    for (JointActuator& each : actuators_) state(each);
    state(*manager_);
  }

 private:
  /// Keeps readings until the step has been taken.
  class Waiting : public devices::ReadingSink {
   public:
    void on_reading(const devices::Output& output, const devices::Reading& reading) override {
      readings_.emplace_back(&output, reading);
    }
    void give(devices::ReadingSink& sink);
    void clear() { readings_.clear(); }

   private:
    std::vector<std::pair<const devices::Output*, devices::Reading>> readings_;
  };

  void add_joint(const Transmission& transmission, const std::string& scope,
                 devices::DeviceContext& context);
  void add_steer_bot(devices::DeviceContext& context);
  JointHandle& add_handle(const std::string& name, JointInterface interface);
  void add_actuator(JointHandle& handle, std::size_t joint, devices::DeviceContext& context);
  std::optional<PidGains> read_gains(const std::string& joint,
                                     devices::DeviceContext& context) const;
  void add_gains(JointActuator& actuator);
  void add_stop();
  void control(TimeNs now_ns);

  Params params_;
  devices::Robot& robot_;
  Hardware hardware_;
  std::deque<JointActuator> actuators_;
  HardwareSensors sensors_;
  std::optional<SteerBot> steer_bot_;
  std::unique_ptr<Manager> manager_;
  Waiting waiting_;
  TimeNs last_control_ns_ = 0;
  TimeNs last_write_ns_ = 0;
  bool is_stopped_ = false;
  bool was_stopped_ = false;  // in the last control period
};

/// The plugin libgazebo_ros_control.so.
void add_ros_control(devices::Registry& registry);

}  // namespace ardee::control
