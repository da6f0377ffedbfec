// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/description/model.h"
#include "ardee_sim/physics/ode_types.h"
#include "ardee_sim/physics/physics_world.h"

namespace ardee::physics {

/// The step that constraint rows are prepared for, with the world's own ERP and CFM.
struct StepSettings {
  double step_s = 0.001;
  double erp = 0.2;
  double cfm = 0.0;
};

/// What acts along one axis of a joint: stops, motor, dry friction, spring and damper, each a
/// constraint row of its own, so that each holds while the others act. (A joint of ODE has one row
/// for both stop and motor.)
class JointDrive {
 public:
  /// About an axis fixed in body 1 (the child; `rel` 1) or 2 (the parent; `rel` 2).
  static JointDrive rotational(dWorldID world, dBodyID child, dBodyID parent, int rel,
                               const Eigen::Vector3d& axis_W, const JointAxis& axis);
  /// Along a slider's axis; the slider's own row is the stop.
  static JointDrive linear(dWorldID world, dBodyID child, dBodyID parent, dJointID slider,
                           const Eigen::Vector3d& axis_W, const JointAxis& axis);

  void set_motor(double velocity, double max_effort);
  void set_spring(const JointSpring& spring) { spring_ = spring; }
  void set_limits(double lower, double upper);
  /// Negative: the world's.
  void set_stop_softness(double erp, double cfm);
  double clamp(double position) const;
  double clamp_effort(double effort) const;

  /// Sets the rows for a step from the state before it: ERP and CFM depend on the step.
  void prepare(double position, double velocity, const StepSettings& step);

 private:
  JointDrive() = default;
  void read(const JointAxis& axis);
  void prepare_stops(double position, double velocity, const StepSettings& step);
  void set_stop(int parameter, double value);
  void set_stop_row(double low, double high, double position, double erp);
  void prepare_spring(double position, double step_s);
  void set_row(int row, double velocity, double max_effort, double cfm);

  bool rotational_ = true;
  JointHandle stops_;          // rotational: an angular motor that is told the angle
  dJointID slider_ = nullptr;  // linear
  JointHandle rows_;           // motor, friction, spring
  JointSpring spring_;
  double lower_ = 0.0;
  double upper_ = 0.0;
  double max_effort_ = 0.0;
  double friction_ = 0.0;
  double stop_erp_ = -1.0;
  double stop_cfm_ = -1.0;
  double motor_velocity_ = 0.0;
  double motor_effort_ = 0.0;
};

}  // namespace ardee::physics
