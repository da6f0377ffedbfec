// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>

#include "ardee_sim/controllers/drive_controller.h"
#include "ardee_sim/controllers/four_wheel_geometry.h"
#include "ardee_sim/controllers/speed_limiter.h"

namespace ardee::control {

/// four_wheel_steering_controller/FourWheelSteeringController: four driven and steered wheels,
/// commanded by a velocity on "cmd_vel" or by steering angles on "cmd_four_wheel_steering".
class FourWheelSteeringController : public DriveController {
 public:
  static std::unique_ptr<Controller> make(const ControllerContext& context);
  explicit FourWheelSteeringController(const ControllerContext& context);

  void start(TimeNs now_ns) override;
  void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) override;
  void reset(TimeNs now_ns) override;
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

    AxleState state() const;
    void set(const AxleCommand& command);
  };

  std::array<JointHandle*, 2> read_joints(const ControllerContext& context, const std::string& key,
                                          JointInterface interface);
  Axle read_axle(const ControllerContext& context, const std::string& key);
  void brake() override;
  void update_odometry(TimeNs now_ns);
  void publish_steering(TimeNs now_ns, devices::ReadingSink& sink) const;

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

}  // namespace ardee::control
