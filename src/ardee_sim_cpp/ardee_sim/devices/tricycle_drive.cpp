// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "ardee_sim/core/limits.h"
#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/drive_command.h"
#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/names.h"
#include "ardee_sim/devices/odometry_publisher.h"
#include "ardee_sim/devices/sensor.h"
#include "ardee_sim/devices/wheel_encoder.h"
#include "ardee_sim/devices/wheel_publisher.h"

namespace ardee::devices {
namespace {

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

  TricycleDrive(const std::string& name, const Params& params, Robot& robot)
      : Device(name),
        params_(params),
        robot_(robot),
        command_timer_(params.update_rate_hz),
        odometry_(params.odometry, ports(), robot),
        wheels_(params.wheels, params.odometry.rate_hz, ports(), robot) {
    ports().add_velocity_input(params_.command_topic,
                               [this](const Twist& command) { command_.set(command); });
  }

  void before_step(TimeNs now_ns) override {
    const Twist& command = command_.at(now_ns);
    if (!command_timer_.due(now_ns)) return;
    const double elapsed_s = seconds(now_ns - last_command_ns_);
    last_command_ns_ = now_ns;
    if (elapsed_s <= 0.0) return;
    drive(limits::wheel_command(command.linear.x()), elapsed_s);
    steer(std::clamp(command.angular.z(), -M_PI / 2.0, M_PI / 2.0), elapsed_s);
  }
  void after_step(TimeNs now_ns, ReadingSink& sink) override {
    if (!odometry_.due(now_ns)) return;
    wheels_.publish(now_ns, sink);
    odometry_.publish(now_ns, sink);
  }
  void reset(TimeNs now_ns) override {
    command_.reset(now_ns);
    last_command_ns_ = now_ns;
    speed_m_per_s_ = 0.0;
    command_timer_.start_at(now_ns);
    odometry_.reset(now_ns);
  }
  void serialize(StateArchive& state) override {
    state(command_timer_, command_, speed_m_per_s_, last_command_ns_, odometry_);
  }

 private:
  void drive(double wanted_m_per_s, double elapsed_s) {
    const double missing = wanted_m_per_s - speed_m_per_s_;
    const double rate =
        missing > 0.0 ? params_.acceleration_m_per_s2 : params_.deceleration_m_per_s2;
    const bool at_once =
        params_.acceleration_m_per_s2 <= 0.0 || std::abs(missing) < params_.speed_tolerance_m_per_s;
    const double most = rate * elapsed_s;
    speed_m_per_s_ += at_once ? missing : std::clamp(missing, -most, most);
    robot_.dynamics().set_joint_motor(params_.joints[kActuated],
                                      speed_m_per_s_ / (params_.actuated_diameter_m / 2.0),
                                      params_.torque_n_m);
  }
  void steer(double wanted_rad, double elapsed_s) {
    const std::size_t joint = params_.joints[kSteering];
    const double missing = wanted_rad - robot_.dynamics().joint_position(joint);
    double speed = limits::wheel_command(missing / elapsed_s);
    if (const double most = params_.steering_speed_rad_per_s; most > 0.0) {
      const bool is_there = std::abs(missing) < params_.steering_tolerance_rad;
      speed = is_there ? 0.0 : std::clamp(speed, -most, most);
    }
    robot_.dynamics().set_joint_motor(joint, speed, params_.torque_n_m);
  }

  Params params_;
  Robot& robot_;
  RateTimer command_timer_;
  DriveCommand command_{0.0};
  double speed_m_per_s_ = 0.0;  // present set point of the driven wheel
  TimeNs last_command_ns_ = 0;
  OdometryPublisher odometry_;
  WheelPublisher wheels_;
};

OdometryPublisher::Params read_odometry(Parameters& parameters, const std::string& space,
                                        const TricycleDrive::Params& drive,
                                        const DeviceContext& context) {
  OdometryPublisher::Params params = read_odometry_params(parameters, space, context, "base_link");
  params.rate_hz = drive.update_rate_hz;
  const double diameter_m =
      parameters.number("encoderWheelDiameter", 0.15, limits::kSmallestWheel_m);
  const double separation_m =
      parameters.number("encoderWheelSeparation", 0.5, limits::kSmallestWheel_m);
  if (reads_wheels(parameters)) {
    params.wheels = WheelOdometry::Params{{drive.joints[TricycleDrive::kEncoderLeft]},
                                          {drive.joints[TricycleDrive::kEncoderRight]},
                                          diameter_m,
                                          separation_m};
  }
  return params;
}

}  // namespace

std::unique_ptr<Device> make_tricycle_drive(const PluginDescription& plugin, Parameters& parameters,
                                            DeviceContext& context) {
  const std::string space = plugin_namespace(parameters, context);
  TricycleDrive::Params params;
  params.joints = {
      plugin_turning_joint(parameters, context, "steeringJoint", "front_steering_joint"),
      plugin_turning_joint(parameters, context, "actuatedWheelJoint", "front_wheel_joint"),
      plugin_turning_joint(parameters, context, "encoderWheelLeftJoint", "left_rear_wheel_joint"),
      plugin_turning_joint(parameters, context, "encoderWheelRightJoint",
                           "right_rear_wheel_joint")};
  params.actuated_diameter_m =
      parameters.number("actuatedWheelDiameter", 0.15, limits::kSmallestWheel_m);
  params.torque_n_m = parameters.number("wheelTorque", 5.0, 0.0);
  params.acceleration_m_per_s2 = parameters.number("wheelAcceleration", 0.0, 0.0);
  params.deceleration_m_per_s2 =
      parameters.number("wheelDeceleration", params.acceleration_m_per_s2, 0.0);
  params.speed_tolerance_m_per_s = parameters.number("wheelSpeedTolerance", 0.01, 0.0);
  params.steering_speed_rad_per_s = parameters.number("steeringSpeed", 0.0, 0.0);
  params.steering_tolerance_rad = parameters.number("steeringAngleTolerance", 0.01, 0.0);
  params.update_rate_hz = read_update_rate_hz(parameters, 100.0);
  params.command_topic = resolve_topic(parameters.text("commandTopic", "cmd_vel"), space);
  params.odometry = read_odometry(parameters, space, params, context);
  params.wheels = read_wheel_publisher_params(
      parameters, {params.joints.begin(), params.joints.end()}, space, context);
  parameters.ignore({"alwaysOn", "rosDebugLevel"});
  context.robot.dynamics();  // a static model cannot move
  return std::make_unique<TricycleDrive>(plugin.name, params, context.robot);
}

}  // namespace ardee::devices
