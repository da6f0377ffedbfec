// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/core/time.h"
#include "ardee_sim/devices/robot.h"

namespace ardee::devices {

/// Motion of a point of a robot, from its poses before and after each step. It includes the effects
/// of physics and of drives, for any mounting. Setting a model's state between steps causes no
/// spike.
class InertialMotion {
 public:
  /// X_LS is the pose of the point and its axes in the link.
  InertialMotion(const Robot& robot, std::size_t link, const Pose& X_LS)
      : robot_(robot), link_(link), X_LS_(X_LS) {}

  /// Means over some steps, in the axes of S.
  struct Mean {
    Eigen::Vector3d acceleration{0, 0, 0};
    Eigen::Vector3d gravity{0, 0, 0};
    Eigen::Vector3d angular_velocity{0, 0, 0};

    /// Reading of an ideal accelerometer: +g upwards at rest, 0 in free fall.
    Eigen::Vector3d specific_force() const { return acceleration - gravity; }
    void serialize(StateArchive& state) { state(acceleration, gravity, angular_velocity); }
  };

  void reset(TimeNs now_ns);
  void serialize(StateArchive& state) { state(begun_ns_, X_WS_, velocity_W_, sum_, summed_s_); }
  void on_set_state();
  void begin_step(TimeNs now_ns);
  void end_step(TimeNs now_ns, const Eigen::Vector3d& gravity_W);
  /// Means over the steps since the last call.
  Mean take();

 private:
  Pose pose() const { return robot_.link_pose(link_) * X_LS_; }

  const Robot& robot_;
  std::size_t link_;
  Pose X_LS_;
  TimeNs begun_ns_ = 0;
  Pose X_WS_;                            // when the step began
  Eigen::Vector3d velocity_W_{0, 0, 0};  // mean over the last step
  Mean sum_;                             // integral over summed_s_
  double summed_s_ = 0.0;
};

}  // namespace ardee::devices
