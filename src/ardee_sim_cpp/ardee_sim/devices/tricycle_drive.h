// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <string>

#include "ardee_sim/devices/drive_command.h"
#include "ardee_sim/devices/odometry_publisher.h"
#include "ardee_sim/devices/wheel_publisher.h"

namespace ardee::devices {

/// libgazebo_ros_tricycle_drive.so: one wheel that is driven and steered, two that carry encoders.
/// In a command, linear.x is the speed of the driven wheel's rim in m/s and angular.z the steering
/// angle in rad, at most a quarter turn. Without <steeringSpeed> the motor turns the wheel to its
/// angle within one update (in the stock plugin it jumps there). The encoders' odometry turns in
/// the robot's direction (the stock plugin's turns the other way).
class TricycleDrive : public Device {
 public:
  enum Joint { kSteering, kActuated, kEncoderLeft, kEncoderRight, kJointCount };

  struct Params {
    std::array<std::size_t, kJointCount> joints{};
    double actuated_diameter_m = 0.15;
    double torque_n_m = 5.0;
    double acceleration_m_per_s2 = 0.0;  // of the driven wheel's rim; 0: at once
    double deceleration_m_per_s2 = 0.0;
    double speed_tolerance_m_per_s = 0.01;
    double steering_speed_rad_per_s = 0.0;  // 0: within one update
    double steering_tolerance_rad = 0.01;
    double update_rate_hz = 100.0;
    std::string command_topic;
    OdometryPublisher::Params odometry;
    WheelPublisher::Params wheels;
  };

  static std::unique_ptr<Device> make(const PluginDescription& plugin, Parameters& parameters,
                                      DeviceContext& context);
  TricycleDrive(const std::string& name, const Params& params, Robot& robot);

  void before_step(TimeNs now_ns) override;
  void after_step(TimeNs now_ns, ReadingSink& sink) override;
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override {
    state(command_timer_, command_, speed_m_per_s_, last_command_ns_, odometry_);
  }

 private:
  void drive(double wanted_m_per_s, double elapsed_s);
  void steer(double wanted_rad, double elapsed_s);

  Params params_;
  Robot& robot_;
  RateTimer command_timer_;
  DriveCommand command_{0.0};
  double speed_m_per_s_ = 0.0;  // present set point of the driven wheel
  TimeNs last_command_ns_ = 0;
  OdometryPublisher odometry_;
  WheelPublisher wheels_;
};

}  // namespace ardee::devices
