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

constexpr WithoutPrefix kBelowNamespace = WithoutPrefix::kNamespace;

bool read_legacy_mode(Parameters& parameters, Log& log) {
  if (!parameters.has("legacyMode")) {
    log.warn(
        parameters.source().to_string() +
        ": found no <legacyMode>, expected one: it defaults to true, with left and right "
        "wheel swapped, as in Gazebo; false is right for a robot whose joints are named right");
  }
  return parameters.boolean("legacyMode", true);
}

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

  DiffDrive(const std::string& name, const Params& params, Robot& robot)
      : Device(name),
        params_(params),
        robot_(robot),
        command_timer_(params.update_rate_hz),
        command_(params.command_timeout_s),
        odometry_(params.odometry, ports(), robot),
        wheels_(params.wheels, params.odometry.rate_hz, ports(), robot) {
    ports().add_velocity_input(params_.command_topic,
                               [this](const Twist& command) { command_.set(command); });
  }

  void before_step(TimeNs now_ns) override;
  void after_step(TimeNs now_ns, ReadingSink& sink) override {
    if (!odometry_.due(now_ns)) return;
    wheels_.publish(now_ns, sink);
    odometry_.publish(now_ns, sink);
  }
  void reset(TimeNs now_ns) override {
    command_.reset(now_ns);
    last_command_ns_ = now_ns;
    speeds_m_per_s_.fill(0.0);
    command_timer_.start_at(now_ns);
    odometry_.reset(now_ns);
  }
  void serialize(StateArchive& state) override {
    state(command_timer_, command_, speeds_m_per_s_, last_command_ns_, odometry_);
  }

 private:
  /// Rim speeds in m/s, left and right, of the command.
  std::array<double, kWheelCount> wanted_speeds(const Twist& command) const {
    const double turn = command.angular.z() * params_.wheel_separation_m / 2.0;
    const double swapped = params_.legacy_mode ? -turn : turn;
    return {limits::wheel_command(command.linear.x() - swapped),
            limits::wheel_command(command.linear.x() + swapped)};
  }

  Params params_;
  Robot& robot_;
  RateTimer command_timer_;
  DriveCommand command_;
  std::array<double, kWheelCount> speeds_m_per_s_{};  // present set points of the wheels
  TimeNs last_command_ns_ = 0;
  OdometryPublisher odometry_;
  WheelPublisher wheels_;
};

OdometryPublisher::Params read_odometry(Parameters& parameters, const std::string& space,
                                        const DiffDrive::Params& drive,
                                        const DeviceContext& context) {
  OdometryPublisher::Params params =
      read_odometry_params(parameters, space, context, "base_footprint", kBelowNamespace);
  params.rate_hz = drive.update_rate_hz;
  params.has_message = parameters.boolean("publishOdom", true);
  params.has_transform = parameters.boolean("publishOdomTF", parameters.boolean("publishTf", true));
  if (reads_wheels(parameters)) {
    std::size_t left = drive.joints[DiffDrive::kLeft], right = drive.joints[DiffDrive::kRight];
    if (drive.legacy_mode) std::swap(left, right);
    params.wheels =
        WheelOdometry::Params{{left}, {right}, drive.wheel_diameter_m, drive.wheel_separation_m};
  }
  return params;
}

void DiffDrive::before_step(TimeNs now_ns) {
  const Twist& command = command_.at(now_ns);
  if (!command_timer_.due(now_ns)) return;
  const auto wanted = wanted_speeds(command);
  const double elapsed_s = seconds(now_ns - last_command_ns_);
  last_command_ns_ = now_ns;
  const bool at_once = params_.wheel_acceleration_m_per_s2 <= 0.0;
  const double most = params_.wheel_acceleration_m_per_s2 * elapsed_s;
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    double& speed = speeds_m_per_s_[wheel];
    speed = at_once ? wanted[wheel] : speed + std::clamp(wanted[wheel] - speed, -most, most);
    robot_.dynamics().set_joint_motor(params_.joints[wheel],
                                      speed / (params_.wheel_diameter_m / 2.0), params_.torque_n_m);
  }
}

}  // namespace

std::unique_ptr<Device> make_diff_drive(const PluginDescription& plugin, Parameters& parameters,
                                        DeviceContext& context) {
  const std::string space = plugin_namespace(parameters, context);
  DiffDrive::Params params;
  params.joints = {plugin_turning_joint(parameters, context, "leftJoint", "left_joint"),
                   plugin_turning_joint(parameters, context, "rightJoint", "right_joint")};
  params.wheel_separation_m = parameters.number("wheelSeparation", 0.34, limits::kSmallestWheel_m);
  params.wheel_diameter_m = parameters.number("wheelDiameter", 0.15, limits::kSmallestWheel_m);
  params.wheel_acceleration_m_per_s2 = parameters.number("wheelAcceleration", 0.0, 0.0);
  params.torque_n_m = parameters.number("wheelTorque", 5.0, 0.0);
  params.update_rate_hz = read_update_rate_hz(parameters, 100.0);
  params.command_timeout_s = parameters.number("commandTimeout", 0.0, 0.0);
  params.legacy_mode = read_legacy_mode(parameters, context.log);
  params.command_topic = resolve_topic(parameters.text("commandTopic", "cmd_vel"), space);
  params.odometry = read_odometry(parameters, space, params, context);
  params.wheels = read_wheel_publisher_params(
      parameters, {params.joints[DiffDrive::kRight], params.joints[DiffDrive::kLeft]}, space,
      context, kBelowNamespace);  // in the stock plugin's order
  parameters.ignore({"alwaysOn", "rosDebugLevel"});
  context.robot.dynamics();  // a static model cannot move
  return std::make_unique<DiffDrive>(plugin.name, params, context.robot);
}

}  // namespace ardee::devices
