// SPDX-License-Identifier: MIT
#include <algorithm>
#include <optional>
#include <string>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/device.h"
#include "ardee_sim/devices/drive_command.h"
#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/names.h"
#include "ardee_sim/devices/odometry_publisher.h"

namespace ardee::devices {
namespace {

constexpr double kFastest = 1e3;  // m/s, rad/s: bound of a command

double bounded(double speed) { return std::clamp(speed, -kFastest, kFastest); }

/// libgazebo_ros_planar_move.so: moves the model in the plane as commanded, forwards, sideways and
/// turning, on any ground; gravity still acts.
class PlanarMove : public Device {
 public:
  struct Params {
    double command_timeout_s = 0.0;  // 0: the last command stays
    std::string command_topic;
    std::optional<OdometryPublisher::Params> odometry;
  };

  PlanarMove(const std::string& name, const Params& params, Robot& robot)
      : Device(name), params_(params), robot_(robot), command_(params.command_timeout_s) {
    if (params_.odometry) odometry_.emplace(*params_.odometry, ports(), robot_);
    ports().add_velocity_input(params_.command_topic,
                               [this](const Twist& command) { command_.set(command); });
  }

  void before_step(TimeNs now_ns) override {
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
  void after_step(TimeNs now_ns, ReadingSink& sink) override {
    if (odometry_ && odometry_->due(now_ns)) odometry_->publish(now_ns, sink);
  }
  void reset(TimeNs now_ns) override {
    command_.reset(now_ns);
    if (odometry_) odometry_->reset(now_ns);
  }
  void serialize(StateArchive& state) override { state(command_, odometry_); }

 private:
  Params params_;
  Robot& robot_;
  DriveCommand command_;
  std::optional<OdometryPublisher> odometry_;
};

}  // namespace

std::unique_ptr<Device> make_planar_move(const PluginDescription& plugin, Parameters& parameters,
                                         DeviceContext& context) {
  context.robot.dynamics();  // a static model cannot move
  const std::string space = plugin_namespace(parameters, context);
  PlanarMove::Params params;
  // In the stock plugin a negative number means "never".
  params.command_timeout_s = std::max(parameters.number("cmdTimeout", -1.0), 0.0);
  params.command_topic = resolve_topic(parameters.text("commandTopic", "cmd_vel"), space);
  OdometryPublisher::Params odometry =
      read_odometry_params(parameters, space, context, "base_footprint");
  odometry.rate_hz = parameters.number("odometryRate", 20.0);
  if (odometry.rate_hz > 0.0) params.odometry = odometry;
  parameters.ignore({"alwaysOn"});
  return std::make_unique<PlanarMove>(plugin.name, params, context.robot);
}

}  // namespace ardee::devices
