// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <variant>

#include "ardee_sim/controllers/controller.h"
#include "ardee_sim/controllers/planar_odometry.h"

namespace ardee::control {

/// Base class of ros_control's drives: commands on "cmd_vel" with a timeout, odometry on "odom" and
/// "/tf".
class DriveController : public Controller {
 public:
  void start(TimeNs now_ns) override;
  void stop(TimeNs now_ns) override;
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override {
    state(enable_odometry_tf_, publish_timer_, odometry_, command_, command_is_new_, command_ns_);
  }

 protected:
  using DriveCommand = std::variant<Twist, devices::SteeringCommand>;

  /// `odometry_frame` is the frame of the odometry; no parameter overrides it.
  DriveController(const ControllerContext& context, std::string odometry_frame);

  /// Commands all joints to stop.
  virtual void brake() = 0;

  /// Accepts a command. Throws Error if the drive is not running.
  void take(const DriveCommand& command);
  /// The command in force: the last one, or zero velocity once it is too old.
  DriveCommand command_at(TimeNs now_ns);
  Twist twist_at(TimeNs now_ns) { return std::get<Twist>(command_at(now_ns)); }
  /// Publishes odometry if it is due, and returns whether it was.
  bool publish_odometry(TimeNs now_ns, devices::ReadingSink& sink);

  PlanarOdometry& odometry() { return odometry_; }
  const std::string& base_frame() const { return base_frame_; }
  /// Settings that dynamic_reconfigure can change.
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

/// Reads "velocity_rolling_window_size". Throws Error if it is below 1.
std::size_t read_window(const Setting& settings);

}  // namespace ardee::control
