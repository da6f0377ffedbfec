// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <variant>

#include "ardee_sim/controllers/controller.h"
#include "ardee_sim/controllers/planar_odometry.h"

namespace ardee::control {

/// What the drives of ros_control share: commands on "cmd_vel" that grow old, odometry on "odom"
/// and "/tf".
class DriveController : public Controller {
 public:
  void start(TimeNs now_ns) override;
  void stop(TimeNs now_ns) override;
  void reset(TimeNs now_ns) override;

 protected:
  using DriveCommand = std::variant<Twist, devices::SteeringCommand>;

  /// `odometry_frame`: the frame of the odometry, whatever a parameter says of it.
  DriveController(const ControllerContext& context, std::string odometry_frame);

  /// Commands all joints to rest.
  virtual void brake() = 0;

  /// Takes commands as the drive does while it runs. Throws Error otherwise.
  void take(const DriveCommand& command);
  /// The command that counts now: the last one, or zero velocity once it is too old.
  DriveCommand command_at(TimeNs now_ns);
  Twist twist_at(TimeNs now_ns) { return std::get<Twist>(command_at(now_ns)); }
  /// Whether odometry is due; if so it is published.
  bool publish_odometry(TimeNs now_ns, devices::ReadingSink& sink);

  PlanarOdometry& odometry() { return odometry_; }
  const std::string& base_frame() const { return base_frame_; }
  /// Changed by dynamic_reconfigure.
  PublishTimer& publish_timer() { return publish_timer_; }
  bool& enable_odometry_tf() { return enable_odometry_tf_; }

 private:
  std::string odometry_frame_;
  std::string base_frame_;
  std::array<double, 6> pose_covariance_{};
  std::array<double, 6> twist_covariance_{};
  bool enable_odometry_tf_;
  TimeNs command_timeout_ns_;
  PublishTimer publish_timer_;
  PlanarOdometry odometry_;
  DriveCommand command_;
  bool command_is_new_ = false;
  TimeNs command_ns_ = 0;  // when it came
  devices::Output& odometry_output_;
  devices::Output& tf_output_;
};

/// "velocity_rolling_window_size". Throws Error if it is below 1.
std::size_t read_window(const Setting& settings);

}  // namespace ardee::control
