// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/ros_control.h"

#include <map>

#include "ardee_sim/core/limits.h"
#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/names.h"

namespace ardee::control {
namespace {

constexpr char kHardware[] = "gazebo_ros_control/DefaultRobotHWSim";
constexpr char kGains[] = "gazebo_ros_control/pid_gains/";

bool is_steer_bot(Parameters& parameters, Log& log) {
  const std::string type = parameters.text("robotSimType", kHardware);
  if (type == SteerBot::kType) return true;
  if (type == kHardware) return false;
  log.error(parameters
                .error("robotSimType", "found '" + type + "', expected " + SteerBot::kType +
                                           " or " + kHardware + ", which is taken in its place")
                .what());
  return false;
}

/// Period in ns; 0: each step.
TimeNs read_period(Parameters& parameters, const devices::DeviceContext& context) {
  const TimeNs period_ns =
      nanoseconds(parameters.number("controlPeriod", 0.0, 0.0, limits::kLongestTime_s));
  if (period_ns > 0 && period_ns < context.step_ns) {
    context.log.error(parameters
                          .error("controlPeriod",
                                 "found less than the step, expected as much at least; "
                                 "controllers act each step")
                          .what());
  } else if (period_ns > context.step_ns) {
    context.log.warn(parameters
                         .error("controlPeriod",
                                "found more than the step: controllers act less "
                                "often than the physics")
                         .what());
  }
  return period_ns;
}

RosControl::Params read(Parameters& parameters, devices::DeviceContext& context) {
  RosControl::Params params;
  params.robot_namespace = devices::plugin_namespace(parameters, context);
  params.is_steer_bot = is_steer_bot(parameters, context.log);
  params.period_ns = read_period(parameters, context);
  params.stop_topic = parameters.text("eStopTopic", "");
  params.has_legacy_gains = parameters.boolean("legacyModeNS", false);
  parameters.ignore({"robotParam"});  // the description is already known
  return params;
}

JointInterface read_interface(const Transmission& transmission) {
  static const std::map<std::string, JointInterface> known{
      {"EffortJointInterface", JointInterface::kEffort},
      {"PositionJointInterface", JointInterface::kPosition},
      {"VelocityJointInterface", JointInterface::kVelocity}};
  const std::string& written = transmission.interfaces.front();
  const std::string prefix = "hardware_interface/";
  const bool has_prefix = written.rfind(prefix, 0) == 0;
  const auto found = known.find(has_prefix ? written.substr(prefix.size()) : written);
  if (found != known.end()) return found->second;
  throw Error(transmission.source,
              "transmission '" + transmission.name + "': found hardwareInterface '" + written +
                  "', expected hardware_interface/EffortJointInterface, PositionJointInterface or "
                  "VelocityJointInterface");
}

}  // namespace

std::unique_ptr<devices::Device> RosControl::make(const PluginDescription& plugin,
                                                  Parameters& parameters,
                                                  devices::DeviceContext& context) {
  const Params params = read(parameters, context);
  context.robot.dynamics();  // throws for a static model
  try {
    return std::make_unique<RosControl>(plugin, params, context);
  } catch (const Error& error) {
    context.log.error(std::string(error.what()) +
                      "; there is no controller_manager for the robot '" + context.robot.name() +
                      "'");
    return nullptr;
  }
}

RosControl::RosControl(const PluginDescription& plugin, const Params& params,
                       devices::DeviceContext& context)
    : devices::Device(plugin.name), params_(params), robot_(context.robot), sensors_(context) {
  if (params_.is_steer_bot) add_steer_bot(context);
  for (const Transmission& each : robot_.model().transmissions) {
    if (params_.is_steer_bot) break;  // a SteerBot does not use them
    if (each.joint.rfind(context.scope, 0) == 0) add_joint(each, context.scope, context);
  }
  if (hardware_.empty()) {
    context.log.warn(plugin.element.source,
                     "found no joint in the <transmission>s of the robot, expected some: nothing "
                     "is controlled");
  }
  manager_ =
      std::make_unique<Manager>(ManagerContext{params_.robot_namespace, robot_.model(), hardware_,
                                               sensors_.handles(), context.log, context.parameter});
  add_stop();
}

void RosControl::add_joint(const Transmission& transmission, const std::string& scope,
                           devices::DeviceContext& context) {
  const std::size_t index = robot_.joint_index(transmission.joint, transmission.source);
  const Joint& joint = robot_.model().joints[index];
  const JointInterface interface = read_interface(transmission);
  if (!has_one_axis(joint.type)) {
    context.log.error(Error(transmission.source,
                            "transmission '" + transmission.name + "': found joint '" + joint.name +
                                "', which is held or has no one position; it is "
                                "left out")
                          .what());
    return;
  }
  const std::string name = transmission.joint.substr(scope.size());
  if (hardware_.count(name) > 0) {
    context.log.warn(transmission.source, "found a second transmission of joint '" + name +
                                              "', expected one; it is left out");
    return;
  }
  add_actuator(add_handle(name, interface), index, context);
}

void RosControl::add_steer_bot(devices::DeviceContext& context) {
  const std::string path =
      devices::resolve_topic("steer_bot_hardware_gazebo", params_.robot_namespace);
  steer_bot_.emplace(context.parameter(path), robot_.model(), context.log);
  const std::vector<Joint>& joints = robot_.model().joints;
  for (const auto& [name, interface] : steer_bot_->joints()) {
    JointHandle& handle = add_handle(name, interface);
    for (std::size_t index = 0; index < joints.size(); ++index) {
      if (joints[index].name != name) continue;
      if (!has_one_axis(joints[index].type)) {
        throw Error(joints[index].source, std::string(SteerBot::kType) + ": found joint '" + name +
                                              "', which is held or has no one position");
      }
      add_actuator(handle, index, context);
    }
  }
}

JointHandle& RosControl::add_handle(const std::string& name, JointInterface interface) {
  JointHandle& handle = hardware_[name];
  handle.name = name;
  handle.interface = interface;
  return handle;
}

void RosControl::add_actuator(JointHandle& handle, std::size_t index,
                              devices::DeviceContext& context) {
  const Joint& joint = robot_.model().joints[index];
  const std::string& name = handle.name;
  handle.type = joint.type;
  handle.limits = joint.axis;
  const Setting overrides =
      context.parameter(devices::resolve_topic("joint_limits/" + name, params_.robot_namespace));
  const CommandLimits limits = read_command_limits(joint, overrides, context.log);
  actuators_.emplace_back(handle, index, limits,
                          handle.interface == JointInterface::kEffort || steer_bot_
                              ? std::nullopt
                              : read_gains(name, context));
  add_gains(actuators_.back());
}

std::optional<PidGains> RosControl::read_gains(const std::string& joint,
                                               devices::DeviceContext& context) const {
  Setting gains =
      context.parameter(devices::resolve_topic(kGains + joint, params_.robot_namespace));
  if (!gains.has("p") && params_.has_legacy_gains) {
    gains = context.parameter(devices::resolve_topic(kGains + joint, "/"));
  }
  if (gains.has("p")) return read_pid_gains(gains, context.log);
  context.log.info("joint '" + joint + "': no gains at " + gains.path() +
                   "; it follows its commands without a PID");
  return std::nullopt;
}

void RosControl::add_gains(JointActuator& actuator) {
  Pid* pid = actuator.pid();
  if (!pid) return;
  add_tuning(pid->tuning(
      devices::resolve_topic(kGains + actuator.handle().name, params_.robot_namespace)));
}

void RosControl::add_stop() {
  if (params_.stop_topic.empty()) return;
  ports().add_input<bool>(devices::resolve_topic(params_.stop_topic, params_.robot_namespace),
                          [this](bool is_stopped) { is_stopped_ = is_stopped; });
}

void RosControl::before_step(TimeNs now_ns) {
  const TimeNs passed_ns = now_ns - last_control_ns_;
  if (passed_ns > 0 && passed_ns >= params_.period_ns) control(now_ns);
  const double dt_s = seconds(now_ns - last_write_ns_);
  last_write_ns_ = now_ns;
  if (steer_bot_) steer_bot_->follow(hardware_, dt_s);
  for (JointActuator& each : actuators_) each.write(robot_.dynamics(), dt_s, is_stopped_);
}

void RosControl::control(TimeNs now_ns) {
  const double period_s = seconds(now_ns - last_control_ns_);
  last_control_ns_ = now_ns;
  for (JointActuator& each : actuators_) each.read(robot_.dynamics());
  sensors_.read();
  if (was_stopped_ && !is_stopped_) manager_->restart(now_ns);
  was_stopped_ = is_stopped_;
  manager_->update(now_ns, period_s, waiting_);
}

void RosControl::after_step(TimeNs now_ns, devices::ReadingSink& sink) {
  sensors_.end_step(now_ns);
  waiting_.give(sink);
}

void RosControl::Waiting::give(devices::ReadingSink& sink) {
  for (const auto& [output, reading] : readings_) sink.on_reading(*output, reading);
  readings_.clear();
}

void RosControl::reset(TimeNs now_ns) {
  last_control_ns_ = now_ns;
  last_write_ns_ = now_ns;
  is_stopped_ = false;
  was_stopped_ = false;
  waiting_.clear();
  for (JointActuator& each : actuators_) each.reset(robot_.dynamics());
  if (steer_bot_) steer_bot_->reset(hardware_);
  sensors_.reset(now_ns);
  manager_->reset(now_ns);
}

void add_ros_control(devices::Registry& registry) {
  registry.add_model_plugin("libgazebo_ros_control.so", RosControl::make);
}

}  // namespace ardee::control
