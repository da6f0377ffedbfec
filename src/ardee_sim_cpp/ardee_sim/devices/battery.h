// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "ardee_sim/devices/device.h"
#include "ardee_sim/devices/drive_command.h"

namespace ardee::devices {

/// libardee_ros_battery.so (thesis 4.3.1, Listings A.8, A.12), in two modes. Quick: the voltage
/// falls by a fixed amount each update, to test within seconds how an algorithm reacts to a low
/// battery. Current-driven, if <constantCoef> is given: the drive command draws a current, and the
/// voltage follows the linear model of Gazebo's LinearBatteryPlugin,
///   V = constant + linear (1 - q / capacity) - resistance i,
/// where i is the current smoothed with a time constant and q the charge left.
class Battery : public Device {
 public:
  struct Params {
    double rate_hz = 100.0;
    double capacity_Ah = 5.2;
    double initial_charge_Ah = 5.2;
    double voltage_max_V = 16.0;
    double voltage_min_V = 2.0;
    // quick mode
    double voltage_initial_V = 14.0;
    double voltage_drop_V = 0.01;  // each update
    // current-driven mode
    bool current_driven = false;
    double constant_V = 12.694;
    double linear_V = -100.1424;
    double resistance_ohm = 0.061523;
    double smoothing_s = 1.9499;
    double idle_current_A = 1.0;        // nominal, as the two below
    double current_per_speed = 4.0;     // A per m/s
    double current_per_yaw_rate = 2.0;  // A per rad/s
    std::string command_topic;
    std::string topic;
    std::string state_topic;
    std::string frame;
    std::string name;
  };

  static std::unique_ptr<Device> make(const PluginDescription& plugin, Parameters& parameters,
                                      DeviceContext& context);
  Battery(const std::string& name, const Params& params);

  void after_step(TimeNs now_ns, ReadingSink& sink) override;
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override {
    state(timer_, command_, last_ns_, quick_voltage_V_, charge_Ah_, current_A_);
  }

 private:
  void discharge(double elapsed_s, const Twist& command);
  /// Terminal voltage within the battery's bounds.
  double voltage_V() const;
  BatteryStateReading state() const;

  Params params_;
  RateTimer timer_;
  DriveCommand command_{0.0};
  TimeNs last_ns_ = 0;
  double quick_voltage_V_ = 0.0;
  double charge_Ah_ = 0.0;
  double current_A_ = 0.0;  // smoothed, out of the battery
  Output& output_;
  Output& state_output_;
};

}  // namespace ardee::devices
