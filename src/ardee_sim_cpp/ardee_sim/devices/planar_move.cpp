// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/planar_move.h"

#include <algorithm>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/names.h"

namespace ardee::devices {
namespace {

constexpr double kFastest = 1e3;  // m/s, rad/s: what a command can ask
// Of the pose, as the stock plugin says them: x, y, z, roll, pitch, yaw. It says none of the twist.
constexpr std::array<double, 6> kCovariance = {1e-5, 1e-5, 1e12, 1e12, 1e12, 1e-3};

double bounded(double speed) { return std::clamp(speed, -kFastest, kFastest); }

PlanarMove::Params read(const PluginDescription& plugin, DeviceContext& context) {
  Parameters parameters(plugin.element);
  const std::string space = plugin_namespace(parameters, context);
  PlanarMove::Params params;
  params.odometry_rate_hz = parameters.number("odometryRate", 20.0, 0.0);
  // The stock plugin's way to say "never" is a negative number.
  params.command_timeout_s = std::max(parameters.number("cmdTimeout", -1.0), 0.0);
  params.command_topic = resolve_topic(parameters.text("commandTopic", "cmd_vel"), space);
  params.odometry_topic = resolve_topic(parameters.text("odometryTopic", "odom"), space);
  params.odometry_frame = plugin_frame(parameters, "odometryFrame", "odom", space, context);
  params.base_frame = plugin_frame(parameters, "robotBaseFrame", "base_footprint", space, context);
  parameters.ignore({"alwaysOn"});
  parameters.finish(context.log);
  return params;
}

}  // namespace

std::unique_ptr<Device> PlanarMove::make(const PluginDescription& plugin, DeviceContext& context) {
  context.robot.dynamics();  // a static model cannot move
  return std::make_unique<PlanarMove>(plugin.name, read(plugin, context), context.robot);
}

PlanarMove::PlanarMove(const std::string& name, const Params& params, Robot& robot)
    : Device(name),
      params_(params),
      robot_(robot),
      command_(params.command_timeout_s),
      odometry_timer_(params.odometry_rate_hz) {
  if (params_.odometry_rate_hz > 0.0) {
    odometry_output_ = &add_output(params_.odometry_topic, reading_kind<OdometryReading>());
    tf_output_ = &add_output("/tf", reading_kind<TransformReading>());
  }
  ports().add_velocity_input(params_.command_topic,
                             [this](const Twist& command) { command_.set(command); });
  reset(0);
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
  if (odometry_output_ == nullptr || !odometry_timer_.due(now_ns)) return;
  OdometryReading reading;
  reading.header = {now_ns, params_.odometry_frame};
  reading.child_frame_id = params_.base_frame;
  reading.pose_covariance = kCovariance;
  reading.pose = robot_.pose();
  reading.twist = robot_.planar_twist();
  sink.on_reading(*tf_output_,
                  TransformReading{reading.header, reading.child_frame_id, reading.pose, true});
  if (odometry_output_->demanded) sink.on_reading(*odometry_output_, reading);
}

void PlanarMove::reset(TimeNs now_ns) {
  command_.reset(now_ns);
  odometry_timer_.reset();
  odometry_timer_.start_at(now_ns + 1);
}

}  // namespace ardee::devices
