// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/tricycle_drive.h"

#include <algorithm>
#include <cmath>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/names.h"

namespace ardee::devices {
namespace {

constexpr double kFastest = 1e6;  // m/s, rad/s: what a command can ask of a wheel
// Of the pose, as the stock plugin says them: x, y, z, roll, pitch, yaw. It says none of the twist.
constexpr std::array<double, 6> kCovariance = {1e-5, 1e-5, 1e12, 1e12, 1e12, 1e-3};

void read_joints(Parameters& parameters, const std::string& space, const DeviceContext& context,
                 TricycleDrive::Params& params) {
  static constexpr std::array<std::pair<const char*, const char*>, TricycleDrive::kJointCount>
      kKeys = {{{"steeringJoint", "front_steering_joint"},
                {"actuatedWheelJoint", "front_wheel_joint"},
                {"encoderWheelLeftJoint", "left_rear_wheel_joint"},
                {"encoderWheelRightJoint", "right_rear_wheel_joint"}}};
  for (std::size_t i = 0; i < kKeys.size(); ++i) {
    const auto& [key, fallback] = kKeys[i];
    const Element* given = parameters.block(key);
    params.joints[i] = turning_joint(context, given ? given->text : fallback,
                                     given ? given->source : parameters.source());
    const Joint& joint = context.robot.model().joints[params.joints[i]];
    params.frames[i] = resolve_frame(joint.child, space, context);
    params.parent_frames[i] = resolve_frame(joint.parent, space, context);
  }
}

TricycleDrive::Params read(const PluginDescription& plugin, DeviceContext& context) {
  constexpr double kSmallest = 1e-6;
  Parameters parameters(plugin.element);
  const std::string space = plugin_namespace(parameters, context);
  TricycleDrive::Params params;
  read_joints(parameters, space, context, params);
  params.actuated_diameter_m = parameters.number("actuatedWheelDiameter", 0.15, kSmallest);
  params.encoder_diameter_m = parameters.number("encoderWheelDiameter", 0.15, kSmallest);
  params.encoder_separation_m = parameters.number("encoderWheelSeparation", 0.5, kSmallest);
  params.torque_n_m = parameters.number("wheelTorque", 5.0, 0.0);
  params.acceleration_m_per_s2 = parameters.number("wheelAcceleration", 0.0, 0.0);
  params.deceleration_m_per_s2 =
      parameters.number("wheelDeceleration", params.acceleration_m_per_s2, 0.0);
  params.speed_tolerance_m_per_s = parameters.number("wheelSpeedTolerance", 0.01, 0.0);
  params.steering_speed_rad_per_s = parameters.number("steeringSpeed", 0.0, 0.0);
  params.steering_tolerance_rad = parameters.number("steeringAngleTolerance", 0.01, 0.0);
  params.update_rate_hz = parameters.number("updateRate", 100.0, 0.0);
  params.source = read_odometry_source(parameters);
  params.publish_wheel_tf = parameters.boolean("publishWheelTF", false);
  params.publish_wheel_joints = parameters.boolean("publishWheelJointState", false);
  params.command_topic = resolve_topic(parameters.text("commandTopic", "cmd_vel"), space);
  params.odometry_topic = resolve_topic(parameters.text("odometryTopic", "odom"), space);
  params.joints_topic = resolve_topic("joint_states", space);
  params.odometry_frame = plugin_frame(parameters, "odometryFrame", "odom", space, context);
  params.base_frame = plugin_frame(parameters, "robotBaseFrame", "base_link", space, context);
  parameters.ignore({"alwaysOn", "rosDebugLevel"});
  parameters.finish(context.log);
  return params;
}

}  // namespace

std::unique_ptr<Device> TricycleDrive::make(const PluginDescription& plugin,
                                            DeviceContext& context) {
  return std::make_unique<TricycleDrive>(plugin.name, read(plugin, context), context.robot);
}

TricycleDrive::TricycleDrive(const std::string& name, const Params& params, Robot& robot)
    : Device(name),
      params_(params),
      robot_(robot),
      command_timer_(params.update_rate_hz),
      odometry_timer_(params.update_rate_hz),
      odometry_output_(add_output(params.odometry_topic, reading_kind<OdometryReading>())),
      tf_output_(add_output("/tf", reading_kind<TransformReading>())) {
  if (params_.publish_wheel_joints) {
    joints_output_ = &add_output(params_.joints_topic, reading_kind<JointStateReading>());
  }
  ports().add_velocity_input(params_.command_topic,
                             [this](const Twist& command) { command_.set(command); });
  reset(0);
}

void TricycleDrive::drive(double wanted_m_per_s, double elapsed_s) {
  const double missing = wanted_m_per_s - speed_m_per_s_;
  const double rate = missing > 0.0 ? params_.acceleration_m_per_s2 : params_.deceleration_m_per_s2;
  const bool at_once =
      params_.acceleration_m_per_s2 <= 0.0 || std::abs(missing) < params_.speed_tolerance_m_per_s;
  const double most = rate * elapsed_s;
  speed_m_per_s_ += at_once ? missing : std::clamp(missing, -most, most);
  robot_.dynamics().set_joint_motor(params_.joints[kActuated],
                                    speed_m_per_s_ / (params_.actuated_diameter_m / 2.0),
                                    params_.torque_n_m);
}

void TricycleDrive::steer(double wanted_rad, double elapsed_s) {
  const std::size_t joint = params_.joints[kSteering];
  const double missing = wanted_rad - robot_.dynamics().joint_position(joint);
  double speed = std::clamp(missing / elapsed_s, -kFastest, kFastest);
  if (const double most = params_.steering_speed_rad_per_s; most > 0.0) {
    const bool is_there = std::abs(missing) < params_.steering_tolerance_rad;
    speed = is_there ? 0.0 : std::clamp(speed, -most, most);
  }
  robot_.dynamics().set_joint_motor(joint, speed, params_.torque_n_m);
}

void TricycleDrive::before_step(TimeNs now_ns) {
  const Twist& command = command_.at(now_ns);
  if (!command_timer_.due(now_ns)) return;
  const double elapsed_s = seconds(now_ns - last_command_ns_);
  last_command_ns_ = now_ns;
  if (elapsed_s <= 0.0) return;
  drive(std::clamp(command.linear.x(), -kFastest, kFastest), elapsed_s);
  steer(std::clamp(command.angular.z(), -M_PI / 2.0, M_PI / 2.0), elapsed_s);
}

void TricycleDrive::integrate_wheels() {
  std::array<double, kJointCount> rolled_m{};
  for (const Joint wheel : {kEncoderLeft, kEncoderRight}) {
    const double angle = robot_.dynamics().joint_position(params_.joints[wheel]);
    rolled_m[wheel] = (angle - angles_[wheel]) * params_.encoder_diameter_m / 2.0;
    angles_[wheel] = angle;
  }
  wheel_odometry_.roll(rolled_m[kEncoderLeft], rolled_m[kEncoderRight],
                       params_.encoder_separation_m);
}

OdometryReading TricycleDrive::odometry(TimeNs now_ns) const {
  OdometryReading reading;
  reading.header = {now_ns, params_.odometry_frame};
  reading.child_frame_id = params_.base_frame;
  reading.pose_covariance = kCovariance;
  if (params_.source == OdometrySource::kWorld) {
    reading.pose = robot_.pose();
    reading.twist = robot_.planar_twist();
    return reading;
  }
  const auto rim_speed = [&](Joint wheel) {
    return robot_.dynamics().joint_velocity(params_.joints[wheel]) * params_.encoder_diameter_m /
           2.0;
  };
  const double left = rim_speed(kEncoderLeft), right = rim_speed(kEncoderRight);
  reading.pose = wheel_odometry_.pose();
  reading.twist.linear.x() = 0.5 * (left + right);
  reading.twist.angular.z() = (right - left) / params_.encoder_separation_m;
  return reading;
}

void TricycleDrive::publish_wheels(TimeNs now_ns, ReadingSink& sink) const {
  const Model& model = robot_.model();
  JointStateReading states;
  states.header.stamp_ns = now_ns;
  for (std::size_t i = 0; i < kJointCount; ++i) {
    const auto& joint = model.joints[params_.joints[i]];
    states.names.push_back(joint.name);
    states.positions.push_back(robot_.dynamics().joint_position(params_.joints[i]));
    states.velocities.push_back(robot_.dynamics().joint_velocity(params_.joints[i]));
    if (!params_.publish_wheel_tf) continue;
    const Pose X_WP = robot_.link_pose(robot_.link_index(joint.parent, joint.source));
    const Pose X_WC = robot_.link_pose(robot_.link_index(joint.child, joint.source));
    sink.on_reading(tf_output_, TransformReading{{now_ns, params_.parent_frames[i]},
                                                 params_.frames[i],
                                                 X_WP.inverse() * X_WC});
  }
  if (joints_output_ && joints_output_->demanded) sink.on_reading(*joints_output_, states);
}

void TricycleDrive::after_step(TimeNs now_ns, ReadingSink& sink) {
  if (!odometry_timer_.due(now_ns)) return;
  if (params_.source == OdometrySource::kEncoder) integrate_wheels();
  if (params_.publish_wheel_tf || params_.publish_wheel_joints) publish_wheels(now_ns, sink);
  const OdometryReading reading = odometry(now_ns);
  sink.on_reading(tf_output_,
                  TransformReading{reading.header, reading.child_frame_id, reading.pose, true});
  if (odometry_output_.demanded) sink.on_reading(odometry_output_, reading);
}

void TricycleDrive::reset(TimeNs now_ns) {
  command_.reset(now_ns);
  last_command_ns_ = now_ns;
  speed_m_per_s_ = 0.0;
  command_timer_.reset();
  command_timer_.start_at(now_ns);
  odometry_timer_.reset();
  odometry_timer_.start_at(now_ns + 1);
  wheel_odometry_.reset();
  for (const Joint wheel : {kEncoderLeft, kEncoderRight}) {
    angles_[wheel] = robot_.dynamics().joint_position(params_.joints[wheel]);
  }
}

}  // namespace ardee::devices
