// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <string>

#include "ardee_sim/devices/drive_command.h"
#include "ardee_sim/devices/odometry_publisher.h"
#include "ardee_sim/devices/wheel_publisher.h"

namespace ardee::devices {

/// libgazebo_ros_diff_drive.so: two driven wheels.
class DiffDrive : public Device {
 public:
  enum Wheel { kLeft, kRight, kWheelCount };

  struct Params {
    std::array<std::size_t, kWheelCount> joints{};
    double wheel_separation_m = 0.34;
    double wheel_diameter_m = 0.15;
    double wheel_acceleration_m_per_s2 = 0.0;  // 0: at once
    double torque_n_m = 5.0;
    double update_rate_hz = 100.0;
    double command_timeout_s = 0.0;  // 0: the last command stays
    bool legacy_mode = true;         // the stock plugin's default: left and right are swapped
    std::string command_topic;
    OdometryPublisher::Params odometry;
    WheelPublisher::Params wheels;
  };

  static std::unique_ptr<Device> make(const PluginDescription& plugin, Parameters& parameters,
                                      DeviceContext& context);
  DiffDrive(const std::string& name, const Params& params, Robot& robot);

  void before_step(TimeNs now_ns) override;
  void after_step(TimeNs now_ns, ReadingSink& sink) override;
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override {
    state(command_timer_, command_, speeds_m_per_s_, last_command_ns_, odometry_);
  }

 private:
  /// Rim speeds in m/s, left and right, of the command.
  std::array<double, kWheelCount> wanted_speeds(const Twist& command) const;

  Params params_;
  Robot& robot_;
  RateTimer command_timer_;
  DriveCommand command_;
  std::array<double, kWheelCount> speeds_m_per_s_{};  // present set points of the wheels
  TimeNs last_command_ns_ = 0;
  OdometryPublisher odometry_;
  WheelPublisher wheels_;
};

}  // namespace ardee::devices
