// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/planar_move.h"

#include <algorithm>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/names.h"

namespace ardee::devices {
namespace {

constexpr double kFastest = 1e3;  // m/s, rad/s: bound of a command

double bounded(double speed) { return std::clamp(speed, -kFastest, kFastest); }

PlanarMove::Params planar_move_params(Parameters& parameters, DeviceContext& context) {
  const std::string space = plugin_namespace(parameters, context);
  PlanarMove::Params params;
  // In the stock plugin a negative number means "never".
  params.command_timeout_s = std::max(parameters.number("cmdTimeout", -1.0), 0.0);
  params.command_topic = resolve_topic(parameters.text("commandTopic", "cmd_vel"), space);
  OdometryPublisher::Params odometry =
      read_odometry_params(parameters, space, context, "base_footprint");
  odometry.rate_hz = parameters.number("odometryRate", 20.0, 0.0);
  if (odometry.rate_hz > 0.0) params.odometry = odometry;
  parameters.ignore({"alwaysOn"});
  return params;
}

}  // namespace

std::unique_ptr<Device> PlanarMove::make(const PluginDescription& plugin, Parameters& parameters,
                                         DeviceContext& context) {
  context.robot.dynamics();  // a static model cannot move
  return std::make_unique<PlanarMove>(plugin.name, planar_move_params(parameters, context),
                                      context.robot);
}

PlanarMove::PlanarMove(const std::string& name, const Params& params, Robot& robot)
    : Device(name), params_(params), robot_(robot), command_(params.command_timeout_s) {
  if (params_.odometry) odometry_.emplace(*params_.odometry, ports(), robot_);
  ports().add_velocity_input(params_.command_topic,
                             [this](const Twist& command) { command_.set(command); });
}

void PlanarMove::before_step(TimeNs now_ns) {
  const Twist& command = command_.at(now_ns);
  const double yaw = rpy_from_quaternion(robot_.pose().q).z();
  const Eigen::AngleAxisd heading(yaw, Eigen::Vector3d::UnitZ());
  Twist twist_W;
  twist_W.linear =
      heading * Eigen::Vector3d(bounded(command.linear.x()), bounded(command.linear.y()), 0.0);
  twist_W.linear.z() = robot_.twist().linear.z();
  twist_W.angular.z() = bounded(command.angular.z());
  robot_.dynamics().set_twist(twist_W);
}

void PlanarMove::after_step(TimeNs now_ns, ReadingSink& sink) {
  if (odometry_ && odometry_->due(now_ns)) odometry_->publish(now_ns, sink);
}

void PlanarMove::reset(TimeNs now_ns) {
  command_.reset(now_ns);
  if (odometry_) odometry_->reset(now_ns);
}

}  // namespace ardee::devices
