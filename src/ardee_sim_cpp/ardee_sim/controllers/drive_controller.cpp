// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/drive_controller.h"

#include <algorithm>

#include "ardee_sim/core/error.h"

namespace ardee::control {
namespace {

std::array<double, 6> read_covariance(const Setting& settings, const std::string& key) {
  std::array<double, 6> diagonal{};
  const std::vector<double> numbers = settings.exact_doubles(key, diagonal.size());
  std::copy(numbers.begin(), numbers.end(), diagonal.begin());
  return diagonal;
}

}  // namespace

std::size_t read_window(const Setting& settings) {
  constexpr int kDefaultWindow = 10;
  const int window = settings.integer("velocity_rolling_window_size", kDefaultWindow);
  if (window < 1) {
    throw Error(settings.path() + "/velocity_rolling_window_size: found " + std::to_string(window) +
                ", expected at least 1");
  }
  return static_cast<std::size_t>(window);
}

DriveController::DriveController(const ControllerContext& context, std::string odometry_frame)
    : odometry_frame_(std::move(odometry_frame)),
      base_frame_(context.settings.text("base_frame_id", "base_link")),
      pose_covariance_(read_covariance(context.settings, "pose_covariance_diagonal")),
      twist_covariance_(read_covariance(context.settings, "twist_covariance_diagonal")),
      enable_odometry_tf_(context.settings.boolean("enable_odom_tf", true)),
      command_timeout_ns_(nanoseconds(context.settings.number("cmd_vel_timeout", 0.5))),
      publish_timer_(context.settings.number("publish_rate", 50.0)),
      odometry_(read_window(context.settings)),
      odometry_output_(ports().add_output(context.topic("odom"),
                                          devices::reading_kind<devices::OdometryReading>())),
      tf_output_(ports().add_output("/tf", devices::reading_kind<devices::TransformReading>())) {
  devices::Input& input = ports().add_velocity_input(
      context.topic("cmd_vel"), [this](const Twist& command) { take(command); });
  input.needs_one_publisher = !context.settings.boolean("allow_multiple_cmd_vel_publishers", true);
}

void DriveController::start(TimeNs now_ns) {
  brake();
  command_ = Twist{};
  command_is_new_ = false;
  publish_timer_.start(now_ns);
  odometry_.start(now_ns);
}

void DriveController::stop(TimeNs /*now_ns*/) { brake(); }

void DriveController::reset(TimeNs now_ns) {
  command_ = Twist{};
  command_is_new_ = false;
  command_ns_ = now_ns;
  publish_timer_.start(now_ns);
  odometry_.reset(now_ns);
  for (const devices::ParameterGroup& tuning : ports().all<devices::ParameterGroup>()) {
    for (const devices::TunableParameter& parameter : tuning.parameters)
      parameter.set(parameter.initial);
  }
}

void DriveController::take(const DriveCommand& command) {
  if (!is_running()) throw Error("found a command while the controller is not running");
  command_ = command;
  command_is_new_ = true;
}

DriveController::DriveCommand DriveController::command_at(TimeNs now_ns) {
  if (command_is_new_) {
    command_is_new_ = false;
    command_ns_ = now_ns;
  }
  if (now_ns - command_ns_ <= command_timeout_ns_) return command_;
  if (std::holds_alternative<Twist>(command_)) return Twist{};
  return devices::SteeringCommand{};
}

bool DriveController::publish_odometry(TimeNs now_ns, devices::ReadingSink& sink) {
  if (!publish_timer_.due(now_ns)) return false;
  const devices::Header header{now_ns, odometry_frame_};
  if (odometry_output_.demanded) {
    sink.on_reading(odometry_output_, devices::OdometryReading{
                                          header, base_frame_, odometry_.pose(), odometry_.twist(),
                                          pose_covariance_, twist_covariance_});
  }
  if (enable_odometry_tf_) {
    sink.on_reading(tf_output_,
                    devices::TransformReading{header, base_frame_, odometry_.pose(), true});
  }
  return true;
}

}  // namespace ardee::control
