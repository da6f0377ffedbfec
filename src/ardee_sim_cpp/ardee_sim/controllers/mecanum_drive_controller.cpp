// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include "ardee_sim/controllers/controller_types.h"
#include "ardee_sim/controllers/drive_controller.h"
#include "ardee_sim/controllers/speed_limiter.h"
#include "ardee_sim/controllers/wheel_geometry.h"

namespace ardee::control {
namespace {

constexpr std::array<const char*, 4> kWheelKeys = {
    "front_left_wheel_joint", "back_left_wheel_joint", "back_right_wheel_joint",
    "front_right_wheel_joint"};

/// The distance of two wheels along an axis of the robot, if no parameter gives it.
double read_separation(const ControllerContext& context, const std::string& key,
                       const std::string& other_wheel, int axis) {
  const Setting& settings = context.settings;
  const Setting given = settings.at(key);
  if (given) return positive(settings.number(key), given);
  const Eigen::Vector3d apart = joint_origin(context.model, settings.text(kWheelKeys[0]), given) -
                                joint_origin(context.model, settings.text(other_wheel), given);
  return positive(std::abs(apart[axis]), given);
}

/// mecanum_drive_controller/MecanumDriveController: four wheels with rollers at 45 degrees.
class MecanumDriveController : public DriveController {
 public:
  explicit MecanumDriveController(const ControllerContext& context);

  void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) override {
    update_odometry(now_ns);
    publish_odometry(now_ns, sink);
    const Twist wanted = twist_at(now_ns);
    const double forward = forward_.limit(wanted.linear.x(), period_s);
    const double left = left_.limit(wanted.linear.y(), period_s);
    const double turn = turn_.limit(wanted.angular.z(), period_s) * lever_m_;
    wheels_[kFrontLeft]->command = (forward - left - turn) / radius_m_;
    wheels_[kBackLeft]->command = (forward + left - turn) / radius_m_;
    wheels_[kBackRight]->command = (forward - left + turn) / radius_m_;
    wheels_[kFrontRight]->command = (forward + left + turn) / radius_m_;
  }
  void reset(TimeNs now_ns) override {
    DriveController::reset(now_ns);
    forward_.reset();
    left_.reset();
    turn_.reset();
  }
  void serialize(StateArchive& state) override {
    DriveController::serialize(state);
    state(forward_, left_, turn_);
  }

 private:
  enum Wheel { kFrontLeft, kBackLeft, kBackRight, kFrontRight, kWheelCount };

  void brake() override {
    for (JointHandle* wheel : wheels_) wheel->command = 0.0;
  }
  void update_odometry(TimeNs now_ns) {
    const double front_left = wheels_[kFrontLeft]->velocity;
    const double back_left = wheels_[kBackLeft]->velocity;
    const double back_right = wheels_[kBackRight]->velocity;
    const double front_right = wheels_[kFrontRight]->velocity;
    const double quarter_m = radius_m_ / 4.0;
    odometry().add_velocity(
        {quarter_m * (front_left + back_left + back_right + front_right),
         quarter_m * (-front_left + back_left - back_right + front_right),
         quarter_m / lever_m_ * (-front_left - back_left + back_right + front_right)},
        now_ns);
  }

  std::array<JointHandle*, kWheelCount> wheels_{};
  double radius_m_;
  double lever_m_;  // half of the sum of the wheels' separations
  SpeedLimiter forward_;
  SpeedLimiter left_;
  SpeedLimiter turn_;
};

MecanumDriveController::MecanumDriveController(const ControllerContext& context)
    : DriveController(context, context.settings.text("odom_frame_id", "odom")),
      radius_m_(wheel_radius(context.settings, context.model, context.settings.text(kWheelKeys[0]),
                             WheelShape::kCylinderOrSphere)),
      lever_m_((read_separation(context, "wheel_separation_x", kWheelKeys[kBackLeft], 0) +
                read_separation(context, "wheel_separation_y", kWheelKeys[kFrontRight], 1)) /
               2.0),
      forward_(context.settings, "linear/x"),
      left_(context.settings, "linear/y"),
      turn_(context.settings, "angular/z") {
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    wheels_[i] = &claim(context, context.settings.text(kWheelKeys[i]), JointInterface::kVelocity,
                        context.settings.at(kWheelKeys[i]));
  }
}

}  // namespace

std::unique_ptr<Controller> make_mecanum_drive(const ControllerContext& context) {
  return std::make_unique<MecanumDriveController>(context);
}

}  // namespace ardee::control
