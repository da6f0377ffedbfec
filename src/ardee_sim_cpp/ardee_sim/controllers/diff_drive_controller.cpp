// SPDX-License-Identifier: MIT
#include <limits>
#include <vector>

#include "ardee_sim/controllers/controller_types.h"
#include "ardee_sim/controllers/drive_controller.h"
#include "ardee_sim/controllers/speed_limiter.h"
#include "ardee_sim/controllers/wheel_geometry.h"
#include "ardee_sim/core/error.h"

namespace ardee::control {
namespace {

double read_separation(const ControllerContext& context) {
  const Setting& settings = context.settings;
  const Setting given = settings.at("wheel_separation");
  if (given) return positive(settings.number("wheel_separation"), given);
  const auto origin = [&](const std::string& key) {
    return joint_origin(context.model, joint_names(settings, key).front(), given);
  };
  const Eigen::Vector3d left = origin("left_wheel");
  return positive((left - origin("right_wheel")).norm(), given);
}

/// diff_drive_controller/DiffDriveController: two sides of wheels, all wheels of a side at one
/// speed.
class DiffDriveController : public DriveController {
 public:
  explicit DiffDriveController(const ControllerContext& context);

  void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) override {
    update_odometry(now_ns);
    publish_odometry(now_ns, sink);
    const Twist wanted = twist_at(now_ns);
    const double v = linear_.limit(wanted.linear.x(), period_s);
    const double w = angular_.limit(wanted.angular.z(), period_s);
    if (command_output_ && command_output_->demanded) {
      sink.on_reading(*command_output_,
                      devices::TwistReading{{now_ns, ""}, {{v, 0, 0}, {0, 0, w}}});
    }
    const double turn = w * separation_m() / 2.0;
    for (const Wheel& wheel : left_.wheels) wheel.joint->command = (v - turn) / radius_m(left_);
    for (const Wheel& wheel : right_.wheels) wheel.joint->command = (v + turn) / radius_m(right_);
    if (wheels_output_) publish_wheels(now_ns, period_s, sink);
  }
  void reset(TimeNs now_ns) override {
    DriveController::reset(now_ns);
    linear_.reset();
    angular_.reset();
    for (Side* side : {&left_, &right_}) {
      side->last_rolled_m = 0.0;
      for (Wheel& wheel : side->wheels) {
        wheel.last_velocity = wheel.last_desired_velocity = wheel.desired_position = 0.0;
      }
    }
  }
  void serialize(StateArchive& state) override {
    DriveController::serialize(state);
    state(separation_multiplier_, linear_, angular_);
    for (Side* side : {&left_, &right_}) {
      state(side->radius_multiplier, side->last_rolled_m);
      for (Wheel& wheel : side->wheels) {
        state(wheel.last_velocity, wheel.last_desired_velocity, wheel.desired_position);
      }
    }
  }

 private:
  struct Wheel {
    JointHandle* joint = nullptr;
    double last_velocity = 0.0;
    double last_desired_velocity = 0.0;
    double desired_position = 0.0;
  };
  struct Side {
    std::vector<Wheel> wheels;
    double radius_multiplier = 1.0;
    double last_rolled_m = 0.0;  // a wheel's first position counts as 0
  };

  Side read_side(const ControllerContext& context, const std::string& key) {
    Side side;
    const std::string wheel_key = key + "_wheel";
    for (const std::string& name : joint_names(context.settings, wheel_key)) {
      Wheel wheel;
      wheel.joint =
          &claim(context, name, JointInterface::kVelocity, context.settings.at(wheel_key));
      side.wheels.push_back(wheel);
    }
    const bool both = context.settings.has("wheel_radius_multiplier");
    side.radius_multiplier = read_multiplier(
        context.settings, both ? "wheel_radius_multiplier" : key + "_wheel_radius_multiplier");
    return side;
  }
  void add_tuning(const ControllerContext& context);
  void brake() override {
    for (Side* side : {&left_, &right_}) {
      for (const Wheel& wheel : side->wheels) wheel.joint->command = 0.0;
    }
  }
  double separation_m() const { return separation_m_ * separation_multiplier_; }
  double radius_m(const Side& side) const { return radius_m_ * side.radius_multiplier; }
  /// Distance that a side has rolled since the last call.
  double roll(Side& side) const {
    double angle = 0.0;
    for (const Wheel& wheel : side.wheels) angle += wheel.joint->position;
    const double rolled_m = angle / static_cast<double>(side.wheels.size()) * radius_m(side);
    const double way_m = rolled_m - side.last_rolled_m;
    side.last_rolled_m = rolled_m;
    return way_m;
  }
  void update_odometry(TimeNs now_ns) {
    if (open_loop_) {
      odometry().add_velocity({linear_.last(), 0.0, angular_.last()}, now_ns);
      return;
    }
    const double left_m = roll(left_);
    const double right_m = roll(right_);
    odometry().add_way({(right_m + left_m) / 2.0, 0.0, (right_m - left_m) / separation_m()},
                       now_ns);
  }
  void publish_wheels(TimeNs now_ns, double period_s, devices::ReadingSink& sink);

  Side left_;
  Side right_;
  bool open_loop_;
  double separation_multiplier_;
  double separation_m_;
  double radius_m_;
  SpeedLimiter linear_;
  SpeedLimiter angular_;
  devices::Output* command_output_ = nullptr;
  devices::Output* wheels_output_ = nullptr;
};

DiffDriveController::DiffDriveController(const ControllerContext& context)
    : DriveController(context, context.settings.text("odom_frame_id", "odom")),
      left_(read_side(context, "left")),
      right_(read_side(context, "right")),
      open_loop_(context.settings.boolean("open_loop", false)),
      separation_multiplier_(read_multiplier(context.settings, "wheel_separation_multiplier")),
      separation_m_(read_separation(context)),
      radius_m_(wheel_radius(context.settings, context.model,
                             joint_names(context.settings, "left_wheel").front(),
                             WheelShape::kCylinderOrSphere)),
      linear_(context.settings, "linear/x"),
      angular_(context.settings, "angular/z") {
  if (left_.wheels.size() != right_.wheels.size()) {
    throw Error(context.settings.path() + ": found a left_wheel list of " +
                std::to_string(left_.wheels.size()) + " and a right_wheel list of " +
                std::to_string(right_.wheels.size()) + ", expected as many on each side");
  }
  if (context.settings.boolean("publish_cmd", false)) {
    command_output_ = &ports().add_output(context.topic("cmd_vel_out"),
                                          devices::reading_kind<devices::TwistReading>());
  }
  if (context.settings.boolean("publish_wheel_joint_controller_state", false)) {
    wheels_output_ =
        &ports().add_output(context.topic("wheel_joint_controller_state"),
                            devices::reading_kind<devices::TrajectoryControllerReading>());
  }
  add_tuning(context);
}

void DiffDriveController::add_tuning(const ControllerContext& context) {
  using Tunable = devices::TunableParameter;
  const auto multiplier = [](const std::string& name, const std::string& description,
                             double& value) {
    const auto get = [&value] { return value; };
    const auto set = [&value](double number) { value = number; };
    return Tunable{name, description, Tunable::Type::kDouble, 0.5, 1.5, value, get, set};
  };
  constexpr double kHighestRateHz = 2000.0;
  PublishTimer& timer = publish_timer();
  bool& tf = enable_odometry_tf();
  ports().add<devices::ParameterGroup>(
      {context.own_name(),
       {multiplier("left_wheel_radius_multiplier", "Left wheel radius multiplier.",
                   left_.radius_multiplier),
        multiplier("right_wheel_radius_multiplier", "Right wheel radius multiplier.",
                   right_.radius_multiplier),
        multiplier("wheel_separation_multiplier", "Wheel separation multiplier.",
                   separation_multiplier_),
        {"publish_rate", "Publish rate of odom.", Tunable::Type::kDouble, 0.0, kHighestRateHz,
         timer.rate_hz(), [&timer] { return timer.rate_hz(); },
         [&timer](double rate_hz) { timer.set_rate(rate_hz); }},
        {"enable_odom_tf", "Publish odom frame to tf.", Tunable::Type::kBool, 0.0, 1.0,
         tf ? 1.0 : 0.0, [&tf] { return tf ? 1.0 : 0.0; },
         [&tf](double number) { tf = number != 0.0; }}}});
}

void DiffDriveController::publish_wheels(TimeNs now_ns, double period_s,
                                         devices::ReadingSink& sink) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  devices::TrajectoryControllerReading state;
  state.header.stamp_ns = now_ns;
  const auto add = [](devices::JointTrajectoryPoint& point, double position, double velocity,
                      double acceleration, double effort) {
    point.positions.push_back(position);
    point.velocities.push_back(velocity);
    point.accelerations.push_back(acceleration);
    point.efforts.push_back(effort);
  };
  for (Side* side : {&left_, &right_}) {
    for (Wheel& wheel : side->wheels) {
      const JointHandle& joint = *wheel.joint;
      wheel.desired_position += joint.command * period_s;
      const double acceleration = (joint.velocity - wheel.last_velocity) / period_s;
      const double desired_acceleration = (joint.command - wheel.last_desired_velocity) / period_s;
      wheel.last_velocity = joint.velocity;
      wheel.last_desired_velocity = joint.command;
      state.names.push_back(joint.name);
      add(state.actual, joint.position, joint.velocity, acceleration, joint.effort);
      add(state.desired, wheel.desired_position, joint.command, desired_acceleration, kUnknown);
      add(state.error, wheel.desired_position - joint.position, joint.command - joint.velocity,
          desired_acceleration - acceleration, kUnknown);
    }
  }
  if (wheels_output_->demanded) sink.on_reading(*wheels_output_, state);
}

}  // namespace

std::unique_ptr<Controller> make_diff_drive(const ControllerContext& context) {
  return std::make_unique<DiffDriveController>(context);
}

}  // namespace ardee::control
