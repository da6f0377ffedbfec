// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "ardee_sim/controllers/drive_controller.h"
#include "ardee_sim/controllers/speed_limiter.h"

namespace ardee::control {

/// diff_drive_controller/DiffDriveController: two sides of wheels, all wheels of a side at one
/// speed.
class DiffDriveController : public DriveController {
 public:
  static std::unique_ptr<Controller> make(const ControllerContext& context);
  explicit DiffDriveController(const ControllerContext& context);

  void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) override;
  void reset(TimeNs now_ns) override;
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

  Side read_side(const ControllerContext& context, const std::string& key);
  void add_tuning(const ControllerContext& context);
  void brake() override;
  double separation_m() const { return separation_m_ * separation_multiplier_; }
  double radius_m(const Side& side) const { return radius_m_ * side.radius_multiplier; }
  /// Distance that a side has rolled since the last call.
  double roll(Side& side) const;
  void update_odometry(TimeNs now_ns);
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

}  // namespace ardee::control
