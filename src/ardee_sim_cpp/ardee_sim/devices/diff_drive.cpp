// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/diff_drive.h"

#include <algorithm>
#include <cmath>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/names.h"

namespace ardee::devices {
namespace {

constexpr WithoutPrefix kBelowNamespace = WithoutPrefix::kNamespace;
constexpr double kFastest = 1e6;  // m/s: what a command can ask of a wheel
// Of the pose, as the stock plugin says them: x, y, z, roll, pitch, yaw. It says none of the twist.
constexpr std::array<double, 6> kCovariance = {1e-5, 1e-5, 1e12, 1e12, 1e12, 1e-3};

void read_wheels(Parameters& parameters, const std::string& space, const DeviceContext& context,
                 DiffDrive::Params& params) {
  static constexpr std::array<const char*, DiffDrive::kWheelCount> kKeys = {"leftJoint",
                                                                            "rightJoint"};
  static constexpr std::array<const char*, DiffDrive::kWheelCount> kDefaults = {"left_joint",
                                                                                "right_joint"};
  for (std::size_t wheel = 0; wheel < params.joints.size(); ++wheel) {
    const Element* given = parameters.block(kKeys[wheel]);
    params.joints[wheel] = turning_joint(context, given ? given->text : kDefaults[wheel],
                                         given ? given->source : parameters.source());
    const Joint& joint = context.robot.model().joints[params.joints[wheel]];
    params.wheel_frames[wheel] = resolve_frame(joint.child, space, context, kBelowNamespace);
    params.wheel_parent_frames[wheel] =
        resolve_frame(joint.parent, space, context, kBelowNamespace);
  }
}

bool read_legacy_mode(Parameters& parameters, Log& log) {
  if (!parameters.has("legacyMode")) {
    log.warn(
        parameters.source().to_string() +
        ": found no <legacyMode>, expected one: it defaults to true, with left and right "
        "wheel swapped, as in Gazebo; false is right for a robot whose joints are named right");
  }
  return parameters.boolean("legacyMode", true);
}

DiffDrive::Params read(const PluginDescription& plugin, DeviceContext& context) {
  constexpr double kSmallest = 1e-6;
  Parameters parameters(plugin.element);
  const std::string space = plugin_namespace(parameters, context);
  DiffDrive::Params params;
  read_wheels(parameters, space, context, params);
  params.wheel_separation_m = parameters.number("wheelSeparation", 0.34, kSmallest);
  params.wheel_diameter_m = parameters.number("wheelDiameter", 0.15, kSmallest);
  params.wheel_acceleration_m_per_s2 = parameters.number("wheelAcceleration", 0.0, 0.0);
  params.torque_n_m = parameters.number("wheelTorque", 5.0, 0.0);
  params.update_rate_hz = parameters.number("updateRate", 100.0, 0.0);
  params.command_timeout_s = parameters.number("commandTimeout", 0.0, 0.0);
  params.source = read_odometry_source(parameters);
  params.legacy_mode = read_legacy_mode(parameters, context.log);
  params.publish_odometry = parameters.boolean("publishOdom", true);
  params.publish_odometry_tf =
      parameters.boolean("publishOdomTF", parameters.boolean("publishTf", true));
  params.publish_wheel_tf = parameters.boolean("publishWheelTF", false);
  params.publish_wheel_joints = parameters.boolean("publishWheelJointState", false);
  params.command_topic = resolve_topic(parameters.text("commandTopic", "cmd_vel"), space);
  params.odometry_topic = resolve_topic(parameters.text("odometryTopic", "odom"), space);
  params.joints_topic = resolve_topic("joint_states", space);
  params.odometry_frame =
      plugin_frame(parameters, "odometryFrame", "odom", space, context, kBelowNamespace);
  params.base_frame =
      plugin_frame(parameters, "robotBaseFrame", "base_footprint", space, context, kBelowNamespace);
  parameters.ignore({"alwaysOn", "rosDebugLevel"});
  parameters.finish(context.log);
  return params;
}

}  // namespace

std::unique_ptr<Device> DiffDrive::make(const PluginDescription& plugin, DeviceContext& context) {
  return std::make_unique<DiffDrive>(plugin.name, read(plugin, context), context.robot);
}

DiffDrive::DiffDrive(const std::string& name, const Params& params, Robot& robot)
    : Device(name),
      params_(params),
      robot_(robot),
      command_timer_(params.update_rate_hz),
      odometry_timer_(params.update_rate_hz),
      command_(params.command_timeout_s) {
  if (params_.publish_odometry) {
    odometry_output_ = &add_output(params_.odometry_topic, reading_kind<OdometryReading>());
  }
  if (params_.publish_odometry_tf || params_.publish_wheel_tf) {
    tf_output_ = &add_output("/tf", reading_kind<TransformReading>());
  }
  if (params_.publish_wheel_joints) {
    joints_output_ = &add_output(params_.joints_topic, reading_kind<JointStateReading>());
  }
  ports().add_velocity_input(params_.command_topic,
                             [this](const Twist& command) { command_.set(command); });
  reset(0);
}

std::array<double, DiffDrive::kWheelCount> DiffDrive::wanted_speeds(const Twist& command) const {
  const double turn = command.angular.z() * params_.wheel_separation_m / 2.0;
  const double swapped = params_.legacy_mode ? -turn : turn;
  return {std::clamp(command.linear.x() - swapped, -kFastest, kFastest),
          std::clamp(command.linear.x() + swapped, -kFastest, kFastest)};
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

void DiffDrive::integrate_wheels() {
  std::array<double, kWheelCount> rolled_m{};
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    const double angle = robot_.dynamics().joint_position(params_.joints[wheel]);
    rolled_m[wheel] = (angle - wheel_angles_[wheel]) * params_.wheel_diameter_m / 2.0;
    wheel_angles_[wheel] = angle;
  }
  if (params_.legacy_mode) std::swap(rolled_m[kLeft], rolled_m[kRight]);
  wheel_odometry_.roll(rolled_m[kLeft], rolled_m[kRight], params_.wheel_separation_m);
}

OdometryReading DiffDrive::odometry(TimeNs now_ns) const {
  OdometryReading reading;
  reading.header = {now_ns, params_.odometry_frame};
  reading.child_frame_id = params_.base_frame;
  reading.pose_covariance = kCovariance;
  if (params_.source == OdometrySource::kWorld) {
    reading.pose = robot_.pose();
    reading.twist = robot_.planar_twist();
    return reading;
  }
  const auto rim_speed = [&](Wheel wheel) {
    return robot_.dynamics().joint_velocity(params_.joints[wheel]) * params_.wheel_diameter_m / 2.0;
  };
  const double left = rim_speed(params_.legacy_mode ? kRight : kLeft);
  const double right = rim_speed(params_.legacy_mode ? kLeft : kRight);
  reading.pose = wheel_odometry_.pose();
  reading.twist.linear.x() = 0.5 * (left + right);
  reading.twist.angular.z() = (right - left) / params_.wheel_separation_m;
  return reading;
}

void DiffDrive::publish_wheels(TimeNs now_ns, ReadingSink& sink) const {
  const Model& model = robot_.model();
  JointStateReading states;
  states.header.stamp_ns = now_ns;
  for (const Wheel wheel : {kRight, kLeft}) {  // in the stock plugin's order
    const std::size_t joint = params_.joints[wheel];
    states.names.push_back(model.joints[joint].name);
    states.positions.push_back(robot_.dynamics().joint_position(joint));
    states.velocities.push_back(robot_.dynamics().joint_velocity(joint));
    if (!params_.publish_wheel_tf) continue;
    const Source& source = model.joints[joint].source;
    const Pose X_WP = robot_.link_pose(robot_.link_index(model.joints[joint].parent, source));
    const Pose X_WC = robot_.link_pose(robot_.link_index(model.joints[joint].child, source));
    sink.on_reading(*tf_output_, TransformReading{{now_ns, params_.wheel_parent_frames[wheel]},
                                                  params_.wheel_frames[wheel],
                                                  X_WP.inverse() * X_WC});
  }
  if (joints_output_ && joints_output_->demanded) sink.on_reading(*joints_output_, states);
}

void DiffDrive::after_step(TimeNs now_ns, ReadingSink& sink) {
  if (!odometry_timer_.due(now_ns)) return;
  if (params_.source == OdometrySource::kEncoder) integrate_wheels();
  if (params_.publish_wheel_tf || params_.publish_wheel_joints) publish_wheels(now_ns, sink);
  const OdometryReading reading = odometry(now_ns);
  if (params_.publish_odometry_tf) {
    sink.on_reading(*tf_output_,
                    TransformReading{reading.header, reading.child_frame_id, reading.pose, true});
  }
  if (odometry_output_ && odometry_output_->demanded) sink.on_reading(*odometry_output_, reading);
}

void DiffDrive::reset(TimeNs now_ns) {
  command_.reset(now_ns);
  last_command_ns_ = now_ns;
  speeds_m_per_s_.fill(0.0);
  command_timer_.reset();
  command_timer_.start_at(now_ns);
  odometry_timer_.reset();
  odometry_timer_.start_at(now_ns + 1);
  wheel_odometry_.reset();
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    wheel_angles_[wheel] = robot_.dynamics().joint_position(params_.joints[wheel]);
  }
}

}  // namespace ardee::devices
