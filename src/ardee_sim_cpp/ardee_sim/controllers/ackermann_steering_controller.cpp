// SPDX-License-Identifier: MIT
#include <cmath>

#include "ardee_sim/controllers/controller_types.h"
#include "ardee_sim/controllers/drive_controller.h"
#include "ardee_sim/controllers/speed_limiter.h"
#include "ardee_sim/controllers/wheel_geometry.h"

namespace ardee::control {
namespace {

constexpr const char* kRearWheel = "rear_wheel";
constexpr const char* kFrontSteer = "front_steer";

std::string rear_wheel(const Setting& settings) {
  return settings.text(kRearWheel, "rear_wheel_joint");
}
std::string front_steer(const Setting& settings) {
  return settings.text(kFrontSteer, "front_steer_joint");
}

double read_wheel_base(const ControllerContext& context) {
  const Setting given = context.settings.at("wheel_separation_h");
  if (given) return positive(context.settings.number("wheel_separation_h"), given);
  return positive(std::abs(joint_origin(context.model, rear_wheel(context.settings), given).x() -
                           joint_origin(context.model, front_steer(context.settings), given).x()),
                  given);
}

/// ackermann_steering_controller/AckermannSteeringController: one driven wheel at the rear, one
/// steered at the front. The command's angular z is the steering angle in rad.
class AckermannSteeringController : public DriveController {
 public:
  explicit AckermannSteeringController(const ControllerContext& context);

  void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) override {
    update_odometry(now_ns);
    publish_odometry(now_ns, sink);
    const Twist wanted = twist_at(now_ns);
    rear_wheel_.command = linear_.limit(wanted.linear.x(), period_s) / radius_m_;
    front_steer_.command = steering_.limit(wanted.angular.z(), period_s);
  }
  void reset(TimeNs now_ns) override {
    DriveController::reset(now_ns);
    linear_.reset();
    steering_.reset();
    last_rolled_m_ = 0.0;
  }
  void serialize(StateArchive& state) override {
    DriveController::serialize(state);
    state(linear_, steering_, last_rolled_m_);
  }

 private:
  void brake() override {
    rear_wheel_.command = 0.0;
    front_steer_.command = 0.0;
  }
  void update_odometry(TimeNs now_ns) {
    if (open_loop_) {
      const double turn = linear_.last() * std::tan(steering_.last()) / odometry_base_m_;
      odometry().add_velocity({linear_.last(), 0.0, turn}, now_ns);
      return;
    }
    const double rolled_m = rear_wheel_.position * odometry_radius_m_;
    const double way_m = rolled_m - last_rolled_m_;
    last_rolled_m_ = rolled_m;
    const double steer = front_steer_.position * steer_multiplier_;
    odometry().add_way({way_m, 0.0, std::tan(steer) * way_m / odometry_base_m_}, now_ns);
  }

  JointHandle& rear_wheel_;
  JointHandle& front_steer_;
  bool open_loop_;
  double radius_m_;  // used for commands
  double odometry_base_m_;
  double odometry_radius_m_;
  double steer_multiplier_;
  SpeedLimiter linear_;
  SpeedLimiter steering_;
  double last_rolled_m_ = 0.0;  // the wheel's first position counts as 0
};

AckermannSteeringController::AckermannSteeringController(const ControllerContext& context)
    : DriveController(context, context.settings.text("odom_frame_id", "odom")),
      rear_wheel_(claim(context, rear_wheel(context.settings), JointInterface::kVelocity,
                        context.settings.at(kRearWheel))),
      front_steer_(claim(context, front_steer(context.settings), JointInterface::kPosition,
                         context.settings.at(kFrontSteer))),
      open_loop_(context.settings.boolean("open_loop", false)),
      radius_m_(wheel_radius(context.settings, context.model, rear_wheel(context.settings),
                             WheelShape::kCylinder)),
      odometry_base_m_(read_wheel_base(context) *
                       read_multiplier(context.settings, "wheel_separation_h_multiplier")),
      odometry_radius_m_(radius_m_ * read_multiplier(context.settings, "wheel_radius_multiplier")),
      steer_multiplier_(read_multiplier(context.settings, "steer_pos_multiplier")),
      linear_(context.settings, "linear/x"),
      steering_(context.settings, "angular/z") {}

}  // namespace

std::unique_ptr<Controller> make_ackermann_steering(const ControllerContext& context) {
  return std::make_unique<AckermannSteeringController>(context);
}

}  // namespace ardee::control
