// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/description/model.h"
#include "ardee_sim/physics/ode_types.h"
#include "ardee_sim/physics/properties.h"

namespace ardee::physics {

/// The step that constraint rows are prepared for, with the world's own ERP and CFM.
struct StepSettings {
  double step_s = 0.001;
  double erp = 0.2;
  double cfm = 0.0;
};

/// Stops, motor, dry friction, spring and damper along one axis of a joint, each a separate
/// constraint row, so that each holds while the others act. (A joint of ODE has one row for both
/// stop and motor.)
class JointDrive {
 public:
  /// About an axis fixed in body 1 (the child; `rel` 1) or 2 (the parent; `rel` 2).
  static JointDrive rotational(dWorldID world, dBodyID child, dBodyID parent, int rel,
                               const Eigen::Vector3d& axis_W, const JointProperties& properties);
  /// Along a slider's axis; the slider's own row is the stop.
  static JointDrive linear(dWorldID world, dBodyID child, dBodyID parent, dJointID slider,
                           const Eigen::Vector3d& axis_W, const JointProperties& properties);

  const JointProperties& properties() const { return properties_; }
  void set_properties(const JointProperties& properties) { properties_ = properties; }
  const JointMotor& motor() const { return motor_; }
  /// As in Gazebo, the limits of effort and velocity do not bound a drive's motor.
  void set_motor(const JointMotor& motor) { motor_ = motor; }
  void serialize(StateArchive& state) { state(properties_, motor_); }

  double clamp(double position) const;
  /// Effort clamped to the limit of effort and, at this velocity, to the limit of velocity.
  double clamp_effort(double effort, double velocity) const;

  /// Points the rows along a direction of length `gain`: motion along it is `gain` times as fast as
  /// that of the axis.
  void aim(const Eigen::Vector3d& direction_W, double gain);

  /// ODE joints behind the rows, without the slider's own joint.
  std::vector<dJointID> joints() const;

  /// Sets the rows for a step from the state before it: ERP and CFM depend on the step.
  void prepare(double position, double velocity, const StepSettings& step);

 private:
  JointDrive() = default;
  void prepare_stops(double position, double velocity, const StepSettings& step);
  void set_stop(int parameter, double value);
  void set_stop_row(double low, double high, double position, double erp);
  void prepare_spring(double position, double step_s);
  void set_row(int row, double velocity, double max_effort, double cfm);

  bool rotational_ = true;
  int rel_ = 2;
  double gain_ = 1.0;
  JointHandle stops_;          // rotational: an angular motor that is given the angle
  dJointID slider_ = nullptr;  // linear
  JointHandle rows_;           // motor, friction, spring
  JointProperties properties_;
  JointMotor motor_;
};

}  // namespace ardee::physics
