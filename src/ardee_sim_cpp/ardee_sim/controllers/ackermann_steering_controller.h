// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "ardee_sim/controllers/drive_controller.h"
#include "ardee_sim/controllers/speed_limiter.h"

namespace ardee::control {

/// ackermann_steering_controller/AckermannSteeringController: one driven wheel at the rear, one
/// steered at the front. The command's angular z is the steering angle in rad.
class AckermannSteeringController : public DriveController {
 public:
  static std::unique_ptr<Controller> make(const ControllerContext& context);
  explicit AckermannSteeringController(const ControllerContext& context);

  void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) override;
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override {
    DriveController::serialize(state);
    state(linear_, steering_, last_rolled_m_);
  }

 private:
  void brake() override;
  void update_odometry(TimeNs now_ns);

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

}  // namespace ardee::control
