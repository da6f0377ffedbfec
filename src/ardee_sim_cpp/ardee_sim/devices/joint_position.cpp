// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/device.h"
#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/names.h"

namespace ardee::devices {
namespace {

/// 1/s: rate at which the displacement by a disturbance decays.
constexpr double kStiffness_hz = 20.0;
constexpr double kSmallest = 1e-6;
constexpr double kLargest = 1e6;

/// libardee_ros_joint_position.so: a servo that holds a joint at the position commanded on a topic
/// (std_msgs/Float64, rad or m), as effort_controllers/JointPositionController does below
/// gazebo_ros_control. It limits its speed and acceleration: from rest to rest over a distance s it
/// takes s / v + v / a, or 2 sqrt(s / a) if it does not reach v. Commands beyond the joint's limits
/// lead to the limit.
class JointPosition : public Device {
 public:
  struct Params {
    std::size_t joint = 0;
    std::string topic;
    double lower = 0.0;  // rad or m
    double upper = 0.0;
    double max_velocity = 0.0;      // rad/s or m/s
    double max_acceleration = 0.0;  // rad/s^2 or m/s^2
    double max_effort = 0.0;        // N m or N
  };

  JointPosition(const std::string& name, const Params& params, Robot& robot)
      : Device(name), params_(params), robot_(robot) {
    constexpr double kFarthest = std::numeric_limits<double>::max();
    ports().add_number_input(params.topic, -kFarthest, kFarthest, [this](double position) {
      goal_ = std::clamp(position, params_.lower, params_.upper);
    });
    reset(0);
  }

  void before_step(TimeNs now_ns) override {
    const double dt_s = seconds(now_ns - last_ns_);
    last_ns_ = now_ns;
    if (dt_s > 0.0) move_setpoint(dt_s);
    const double off = setpoint_ - robot_.dynamics().joint_position(params_.joint);
    const double wanted =
        std::clamp(velocity_ + kStiffness_hz * off, -params_.max_velocity, params_.max_velocity);
    robot_.dynamics().set_joint_motor(params_.joint, wanted, params_.max_effort);
  }
  /// Holds the joint at its present position.
  void reset(TimeNs now_ns) override {
    goal_ = setpoint_ = robot_.dynamics().joint_position(params_.joint);
    velocity_ = 0.0;
    last_ns_ = now_ns;
  }
  void serialize(StateArchive& state) override { state(goal_, setpoint_, velocity_, last_ns_); }

 private:
  void move_setpoint(double dt_s);

  Params params_;
  Robot& robot_;
  double goal_ = 0.0;
  double setpoint_ = 0.0;  // on the way to the goal
  double velocity_ = 0.0;  // of the setpoint
  TimeNs last_ns_ = 0;
};

void JointPosition::move_setpoint(double dt_s) {
  const double way = goal_ - setpoint_;
  const double most_change = params_.max_acceleration * dt_s;
  if (std::abs(way) <= most_change * dt_s && std::abs(velocity_) <= most_change) {
    setpoint_ = goal_;
    velocity_ = 0.0;
    return;
  }
  // The greatest speed from which it can still brake, and not beyond the goal in this step.
  const double fastest = std::min({params_.max_velocity, std::abs(way) / dt_s,
                                   std::sqrt(2.0 * params_.max_acceleration * std::abs(way))});
  velocity_ =
      std::clamp(std::copysign(fastest, way), velocity_ - most_change, velocity_ + most_change);
  setpoint_ += velocity_ * dt_s;
}

}  // namespace

std::unique_ptr<Device> make_joint_position(const PluginDescription& plugin, Parameters& parameters,
                                            DeviceContext& context) {
  const std::string space = plugin_namespace(parameters, context);
  const std::string name = parameters.required_text("joint");
  const Source& source = parameters.block("joint")->source;
  JointPosition::Params params;
  params.joint = context.joint_index(name, source);
  const Joint& joint = context.robot.model().joints[params.joint];
  if (!has_one_axis(joint.type)) {
    throw Error(source, "found joint '" + name +
                            "', which has no one position, expected a revolute, continuous or "
                            "prismatic one");
  }
  const auto bound = [&](const char* key, double of_joint) {
    return parameters.number(key, std::clamp(of_joint, kSmallest, kLargest), kSmallest, kLargest);
  };
  params.lower = joint.axis.lower;
  params.upper = joint.axis.upper;
  params.max_velocity = bound("maxVelocity", joint.axis.velocity);
  params.max_acceleration = bound("maxAcceleration", kLargest);
  params.max_effort = bound("maxEffort", joint.axis.effort);
  params.topic =
      resolve_topic(parameters.text("commandTopic", name + "_position_controller/command"), space);
  parameters.ignore({"alwaysOn"});
  return std::make_unique<JointPosition>(plugin.name, params, context.robot);
}

}  // namespace ardee::devices
