// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include "ardee_sim/controllers/controller_types.h"
#include "ardee_sim/controllers/drive_controller.h"
#include "ardee_sim/controllers/four_wheel_geometry.h"
#include "ardee_sim/controllers/speed_limiter.h"
#include "ardee_sim/controllers/wheel_geometry.h"
#include "ardee_sim/core/error.h"

namespace ardee::control {
namespace {

double distance(const ControllerContext& context, const std::string& one, const std::string& other,
                const Setting& source) {
  return (joint_origin(context.model, one, source) - joint_origin(context.model, other, source))
      .head<2>()
      .norm();
}

FourWheelGeometry read_geometry(const ControllerContext& context) {
  const Setting& settings = context.settings;
  const std::vector<std::string> front = joint_names(settings, "front_wheel");
  const auto size = [&](const std::string& key, const auto& of_model) {
    const Setting given = settings.at(key);
    return positive(given ? settings.number(key) : of_model(given), given);
  };
  FourWheelGeometry geometry;
  geometry.track_m = size("track", [&](const Setting& source) {
    return distance(context, front[0], front[1], source);
  });
  geometry.radius_m = wheel_radius(settings, context.model, front[0], WheelShape::kCylinder);
  geometry.wheel_base_m = size("wheel_base", [&](const Setting& source) {
    return distance(context, front[0], joint_names(settings, "rear_wheel")[0], source);
  });
  geometry.steering_offset_m = distance(context, joint_names(settings, "front_steering")[0],
                                        front[0], settings.at("front_steering"));
  return geometry;
}

/// four_wheel_steering_controller/FourWheelSteeringController: four driven and steered wheels,
/// commanded by a velocity on "cmd_vel" or by steering angles on "cmd_four_wheel_steering".
class FourWheelSteeringController : public DriveController {
 public:
  explicit FourWheelSteeringController(const ControllerContext& context);

  void start(TimeNs now_ns) override {
    DriveController::start(now_ns);
    for (RollingMean* mean :
         {&acceleration_, &jerk_, &front_.rate_rad_per_s, &rear_.rate_rad_per_s}) {
      mean->clear();
    }
    last_ns_ = now_ns;
  }
  void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) override;
  void reset(TimeNs now_ns) override {
    DriveController::reset(now_ns);
    linear_.reset();
    angular_.reset();
    for (RollingMean* mean :
         {&acceleration_, &jerk_, &front_.rate_rad_per_s, &rear_.rate_rad_per_s}) {
      mean->clear();
    }
    front_.angle_rad = rear_.angle_rad = speed_m_per_s_ = 0.0;
    last_ns_ = now_ns;
  }
  void serialize(StateArchive& state) override {
    DriveController::serialize(state);
    state(linear_, angular_, speed_m_per_s_, acceleration_, jerk_, last_ns_);
    for (Axle* axle : {&front_, &rear_}) state(axle->rate_rad_per_s, axle->angle_rad);
  }

 private:
  struct Axle {
    std::array<JointHandle*, 2> wheels;  // left, right
    std::array<JointHandle*, 2> steering;
    RollingMean rate_rad_per_s;
    double angle_rad = 0.0;

    AxleState state() const {
      return {FourWheelGeometry::virtual_angle(steering[0]->position, steering[1]->position),
              {wheels[0]->velocity, wheels[1]->velocity}};
    }
    void set(const AxleCommand& command) {
      for (std::size_t i = 0; i < wheels.size(); ++i) {
        wheels[i]->command = command.speeds[i];
        steering[i]->command = command.angles[i];
      }
    }
  };

  std::array<JointHandle*, 2> read_joints(const ControllerContext& context, const std::string& key,
                                          JointInterface interface) {
    const std::vector<std::string> names = joint_names(context.settings, key);
    const Setting source = context.settings.at(key);
    if (names.size() != 2) {
      throw Error(source.path() + ": found " + std::to_string(names.size()) +
                  " joints, expected 2, left and right");
    }
    return {&claim(context, names[0], interface, source),
            &claim(context, names[1], interface, source)};
  }
  Axle read_axle(const ControllerContext& context, const std::string& key) {
    return {read_joints(context, key + "_wheel", JointInterface::kVelocity),
            read_joints(context, key + "_steering", JointInterface::kPosition),
            RollingMean(read_window(context.settings))};
  }
  void brake() override {
    front_.set({});
    rear_.set({});
  }
  void update_odometry(TimeNs now_ns);
  void publish_steering(TimeNs now_ns, devices::ReadingSink& sink) const {
    if (!steering_output_.demanded) return;
    sink.on_reading(steering_output_,
                    devices::FourWheelSteeringReading{{now_ns, ""},
                                                      front_.angle_rad,
                                                      rear_.angle_rad,
                                                      front_.rate_rad_per_s.mean(),
                                                      rear_.rate_rad_per_s.mean(),
                                                      speed_m_per_s_,
                                                      acceleration_.mean(),
                                                      jerk_.mean()});
  }

  Axle front_;
  Axle rear_;
  FourWheelGeometry geometry_;
  SpeedLimiter linear_;
  SpeedLimiter angular_;
  double speed_m_per_s_ = 0.0;
  RollingMean acceleration_;
  RollingMean jerk_;
  TimeNs last_ns_ = 0;
  devices::Output& steering_output_;
};

FourWheelSteeringController::FourWheelSteeringController(const ControllerContext& context)
    : DriveController(context, "odom"),
      front_(read_axle(context, "front")),
      rear_(read_axle(context, "rear")),
      geometry_(read_geometry(context)),
      linear_(context.settings, "linear/x"),
      angular_(context.settings, "angular/z"),
      acceleration_(read_window(context.settings)),
      jerk_(read_window(context.settings)),
      steering_output_(
          ports().add_output(context.topic("odom_steer"),
                             devices::reading_kind<devices::FourWheelSteeringReading>())) {
  ports().add_input<devices::SteeringCommand>(
      context.topic("cmd_four_wheel_steering"), [this](const devices::SteeringCommand& command) {
        if (!std::isfinite(command.front_angle_rad) || !std::isfinite(command.rear_angle_rad) ||
            !std::isfinite(command.speed_m_per_s)) {
          throw Error("found a command that is not finite");
        }
        take(command);
      });
}

void FourWheelSteeringController::update_odometry(TimeNs now_ns) {
  constexpr TimeNs kShortestNs = 100'000;
  if (now_ns - last_ns_ < kShortestNs) return;
  const double elapsed_s = seconds(now_ns - last_ns_);
  last_ns_ = now_ns;
  const PlanarMotion velocity = geometry_.velocity(front_.state(), rear_.state());
  odometry().add_velocity(velocity, now_ns);
  for (Axle* axle : {&front_, &rear_}) {
    const double angle_rad = axle->state().angle_rad;
    axle->rate_rad_per_s.add((angle_rad - axle->angle_rad) / elapsed_s);
    axle->angle_rad = angle_rad;
  }
  const double speed = std::copysign(std::hypot(velocity.forward, velocity.left), velocity.forward);
  const double last_acceleration = acceleration_.mean();
  acceleration_.add((speed - speed_m_per_s_) / elapsed_s);
  jerk_.add((acceleration_.mean() - last_acceleration) / elapsed_s);
  speed_m_per_s_ = speed;
}

void FourWheelSteeringController::update(TimeNs now_ns, double period_s,
                                         devices::ReadingSink& sink) {
  update_odometry(now_ns);
  if (publish_odometry(now_ns, sink)) publish_steering(now_ns, sink);
  const DriveCommand wanted = command_at(now_ns);
  std::array<AxleCommand, 2> commands;
  if (const auto* twist = std::get_if<Twist>(&wanted)) {
    const double forward = linear_.limit(twist->linear.x(), period_s);
    commands = geometry_.for_twist(forward, angular_.limit(twist->angular.z(), period_s));
  } else {
    devices::SteeringCommand steering = std::get<devices::SteeringCommand>(wanted);
    steering.speed_m_per_s = linear_.limit(steering.speed_m_per_s, period_s);
    commands = geometry_.for_steering(steering);
  }
  front_.set(commands[0]);
  rear_.set(commands[1]);
}

}  // namespace

std::unique_ptr<Controller> make_four_wheel_steering(const ControllerContext& context) {
  return std::make_unique<FourWheelSteeringController>(context);
}

}  // namespace ardee::control
