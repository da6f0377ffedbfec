// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/skid_steer_drive.h"

#include <cmath>

#include "ardee_sim/core/limits.h"
#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/names.h"
#include "ardee_sim/devices/sensor.h"

namespace ardee::devices {
namespace {

constexpr double kUnknownVariance = 1e12;  // of z, roll and pitch, as in the stock plugin

std::array<std::size_t, SkidSteerDrive::kWheelCount> read_joints(Parameters& parameters,
                                                                 const DeviceContext& context) {
  static constexpr std::array<const char*, SkidSteerDrive::kWheelCount> kKeys = {
      "leftFrontJoint", "rightFrontJoint", "leftRearJoint", "rightRearJoint"};
  static constexpr std::array<const char*, SkidSteerDrive::kWheelCount> kDefaults = {
      "left_front_joint", "right_front_joint", "left_rear_joint", "right_rear_joint"};
  std::array<std::size_t, SkidSteerDrive::kWheelCount> joints{};
  for (std::size_t i = 0; i < joints.size(); ++i) {
    joints[i] = plugin_turning_joint(parameters, context, kKeys[i], kDefaults[i]);
  }
  return joints;
}

/// Encoders on all wheels, if the plugin requests them.
void read_encoders(Parameters& parameters, const std::string& space, bool always,
                   const DeviceContext& context, SkidSteerDrive::Params& params) {
  static constexpr std::array<const char*, SkidSteerDrive::kWheelCount> kKeys = {
      "leftFrontEncoderTopic", "rightFrontEncoderTopic", "leftRearEncoderTopic",
      "rightRearEncoderTopic"};
  static constexpr std::array<const char*, SkidSteerDrive::kWheelCount> kDefaults = {
      "ardee/encoder/fl", "ardee/encoder/fr", "ardee/encoder/rl", "ardee/encoder/rr"};
  if (!always && !parameters.has("pulsesPR")) return;
  for (std::size_t wheel = 0; wheel < SkidSteerDrive::kWheelCount; ++wheel) {
    WheelEncoder::Params encoder = read_encoder_params(parameters);
    encoder.wheel_diameter_m = params.wheel_diameter_m;
    encoder.joint = params.joints[wheel];
    encoder.id = static_cast<int>(wheel);
    const Joint& joint = context.robot.model().joints[encoder.joint];
    encoder.frame = resolve_frame(joint.child, space, context);
    params.encoders.push_back(encoder);
    params.encoder_topics[wheel] =
        resolve_topic(parameters.text(kKeys[wheel], kDefaults[wheel]), space);
  }
}

OdometryPublisher::Params read_odometry(Parameters& parameters, const std::string& space,
                                        const SkidSteerDrive::Params& drive,
                                        const DeviceContext& context) {
  using Drive = SkidSteerDrive;
  OdometryPublisher::Params params =
      read_odometry_params(parameters, space, context, "base_footprint");
  params.rate_hz = drive.update_rate_hz;
  params.has_transform = parameters.boolean("broadcastTF", false);
  params.is_level = true;
  const double x_m2 = parameters.number("covariance_x", 1e-4, 0.0);
  const double y_m2 = parameters.number("covariance_y", 1e-4, 0.0);
  const double yaw_rad2 = parameters.number("covariance_yaw", 0.01, 0.0);
  params.pose_covariance = {x_m2,    y_m2, kUnknownVariance, kUnknownVariance, kUnknownVariance,
                            yaw_rad2};
  params.twist_covariance = params.pose_covariance;
  if (reads_wheels(parameters)) {
    params.wheels =
        WheelOdometry::Params{{drive.joints[Drive::kLeftFront], drive.joints[Drive::kLeftRear]},
                              {drive.joints[Drive::kRightFront], drive.joints[Drive::kRightRear]},
                              drive.wheel_diameter_m,
                              drive.wheel_separation_m};
  }
  return params;
}

SkidSteerDrive::Params skid_steer_drive_params(Parameters& parameters, bool with_encoders,
                                               DeviceContext& context) {
  const std::string space = plugin_namespace(parameters, context);
  SkidSteerDrive::Params params;
  params.joints = read_joints(parameters, context);
  params.wheel_separation_m = parameters.number("wheelSeparation", 0.4, limits::kSmallestWheel_m);
  params.wheel_diameter_m = parameters.number("wheelDiameter", 0.15, limits::kSmallestWheel_m);
  params.torque_n_m = parameters.number("torque", 5.0, 0.0);
  params.update_rate_hz = read_update_rate_hz(parameters, 100.0);
  params.command_timeout_s = parameters.number("commandTimeout", 0.0, 0.0);
  params.command_topic = resolve_topic(parameters.text("commandTopic", "cmd_vel"), space);
  params.odometry = read_odometry(parameters, space, params, context);
  read_encoders(parameters, space, with_encoders, context, params);
  parameters.ignore({"topicName", "alwaysOn"});  // in Listing A.13; the stock plugin reads neither
  context.robot.dynamics();                      // a static model cannot move
  return params;
}

}  // namespace

std::unique_ptr<Device> SkidSteerDrive::make(const PluginDescription& plugin,
                                             Parameters& parameters, DeviceContext& context) {
  return std::make_unique<SkidSteerDrive>(
      plugin.name, skid_steer_drive_params(parameters, false, context), context.robot);
}

std::unique_ptr<Device> SkidSteerDrive::make_with_encoders(const PluginDescription& plugin,
                                                           Parameters& parameters,
                                                           DeviceContext& context) {
  return std::make_unique<SkidSteerDrive>(
      plugin.name, skid_steer_drive_params(parameters, true, context), context.robot);
}

SkidSteerDrive::SkidSteerDrive(const std::string& name, const Params& params, Robot& robot)
    : Device(name),
      params_(params),
      robot_(robot),
      command_timer_(params.update_rate_hz),
      command_(params.command_timeout_s),
      odometry_(params.odometry, ports(), robot) {
  for (std::size_t wheel = 0; wheel < params_.encoders.size(); ++wheel) {
    encoders_.emplace_back(params_.encoders[wheel], robot_);
    encoder_outputs_.push_back(&add_output(params_.encoder_topics[wheel],
                                           reading_kind<EncoderReading>(), params_.update_rate_hz,
                                           params_.encoders[wheel].frame));
  }
  ports().add_velocity_input(params_.command_topic,
                             [this](const Twist& command) { command_.set(command); });
}

double SkidSteerDrive::side_speed(const Params& params, const Twist& command, bool left) {
  const double turn = command.angular.z() * params.wheel_separation_m / 2.0;
  return (command.linear.x() + (left ? -turn : turn)) / (params.wheel_diameter_m / 2.0);
}

void SkidSteerDrive::before_step(TimeNs now_ns) {
  const Twist& command = command_.at(now_ns);
  if (!command_timer_.due(now_ns)) return;
  physics::PhysicsModel& dynamics = robot_.dynamics();
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    const bool left = wheel == kLeftFront || wheel == kLeftRear;
    const double speed = side_speed(params_, command, left);
    dynamics.set_joint_motor(params_.joints[wheel], limits::wheel_command(speed),
                             params_.torque_n_m);
  }
}

void SkidSteerDrive::after_step(TimeNs now_ns, ReadingSink& sink) {
  if (!odometry_.due(now_ns)) return;
  for (std::size_t wheel = 0; wheel < encoders_.size(); ++wheel) {
    sink.on_reading(*encoder_outputs_[wheel], encoders_[wheel].read(now_ns));
  }
  odometry_.publish(now_ns, sink);
}

void SkidSteerDrive::reset(TimeNs now_ns) {
  command_.reset(now_ns);
  command_timer_.start_at(now_ns);
  odometry_.reset(now_ns);
  for (WheelEncoder& encoder : encoders_) encoder.reset(now_ns);
}

}  // namespace ardee::devices
