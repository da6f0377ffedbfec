// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/devices/drive_command.h"
#include "ardee_sim/devices/odometry_publisher.h"
#include "ardee_sim/devices/wheel_encoder.h"

namespace ardee::devices {

/// libgazebo_ros_skid_steer_drive.so (thesis 4.4.4, Listing A.3): four wheels, those of a side at
/// one speed. Each wheel's motor has at most `torque`; there is no PID and no acceleration limit,
/// and the last command holds unless a timeout is set. With <pulsesPR> each wheel has an encoder
/// (thesis 4.3.1); libardee_ros_skid_steer_drive.so has them always.
class SkidSteerDrive : public Device {
 public:
  enum Wheel { kLeftFront, kRightFront, kLeftRear, kRightRear, kWheelCount };

  struct Params {
    std::array<std::size_t, kWheelCount> joints{};
    double wheel_separation_m = 0.4;
    double wheel_diameter_m = 0.15;
    double torque_n_m = 5.0;
    double update_rate_hz = 100.0;
    double command_timeout_s = 0.0;  // 0: the last command stays
    std::string command_topic;
    OdometryPublisher::Params odometry;
    std::vector<WheelEncoder::Params> encoders;  // none, or one per wheel
    std::array<std::string, kWheelCount> encoder_topics;
  };

  static std::unique_ptr<Device> make(const PluginDescription& plugin, Parameters& parameters,
                                      DeviceContext& context);
  static std::unique_ptr<Device> make_with_encoders(const PluginDescription& plugin,
                                                    Parameters& parameters, DeviceContext& context);
  SkidSteerDrive(const std::string& name, const Params& params, Robot& robot);

  /// Wheel speed in rad/s of one side for a command (v in m/s, w in rad/s): (v -+ w * separation /
  /// 2) / (diameter / 2).
  static double side_speed(const Params& params, const Twist& command, bool left);

  void before_step(TimeNs now_ns) override;
  void after_step(TimeNs now_ns, ReadingSink& sink) override;
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override {
    state(command_timer_, command_, odometry_, encoders_);
  }

 private:
  Params params_;
  Robot& robot_;
  RateTimer command_timer_;
  DriveCommand command_;
  OdometryPublisher odometry_;
  std::vector<WheelEncoder> encoders_;
  std::vector<Output*> encoder_outputs_;
};

}  // namespace ardee::devices
