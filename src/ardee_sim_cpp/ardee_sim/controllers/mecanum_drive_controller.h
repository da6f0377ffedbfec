// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>

#include "ardee_sim/controllers/drive_controller.h"
#include "ardee_sim/controllers/speed_limiter.h"

namespace ardee::control {

/// mecanum_drive_controller/MecanumDriveController: four wheels with rollers at 45 degrees.
class MecanumDriveController : public DriveController {
 public:
  static std::unique_ptr<Controller> make(const ControllerContext& context);
  explicit MecanumDriveController(const ControllerContext& context);

  void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) override;
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override {
    DriveController::serialize(state);
    state(forward_, left_, turn_);
  }

 private:
  enum Wheel { kFrontLeft, kBackLeft, kBackRight, kFrontRight, kWheelCount };

  void brake() override;
  void update_odometry(TimeNs now_ns);

  std::array<JointHandle*, kWheelCount> wheels_{};
  double radius_m_;
  double lever_m_;  // half of the sum of the wheels' separations
  SpeedLimiter forward_;
  SpeedLimiter left_;
  SpeedLimiter turn_;
};

}  // namespace ardee::control
