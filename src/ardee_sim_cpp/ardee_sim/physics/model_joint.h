// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "ardee_sim/description/model.h"
#include "ardee_sim/physics/contact.h"
#include "ardee_sim/physics/joint_drive.h"
#include "ardee_sim/physics/joint_kind.h"
#include "ardee_sim/physics/ode_types.h"

namespace ardee::physics {

/// A joint between two bodies, which stand as with all joints at zero when it is made. Positions
/// and velocities are those of the child against the parent about the first axis, as SDF and URDF
/// count them.
class ModelJoint {
 public:
  /// X_WJ: the joint's frame in the world.
  ModelJoint(dWorldID world, const Joint& joint, dBodyID child, dBodyID parent, const Pose& X_WJ);

  /// False for a ball joint and a fixed joint.
  bool has_position() const { return kind_.axes() > 0; }
  double position() const { return position_; }
  double velocity() const;
  /// Rigid motion of the child, in world axes, that brings the first axis to `position`, clamped to
  /// its limits.
  Pose motion_to(double position) const;
  /// Sets the recorded position as given, with any number of turns.
  void set_position(double position) { position_ = position; }
  /// Measures the position anew: of the possible numbers of turns, the one within the limits.
  void take_position();
  double clamp(double position) const;

  /// Number of axes that can be driven; 0 for a ball joint, or between bodies that no force moves.
  std::size_t axes() const { return drive2_ ? 2 : drive_ ? 1 : 0; }
  /// Whether a motor acts on an axis.
  bool is_driven() const;
  JointDrive& drive(std::size_t axis) { return axis == 0 ? drive_.value() : drive2_.value(); }
  /// Follows a shift of the bodies' frames within the bodies, in their own axes.
  void shift_frames(const Eigen::Vector3d& child_C, const Eigen::Vector3d& parent_P);
  /// Keeps each step's wrench from now on.
  void keep_wrench();
  /// Wrench of the child on the joint in the last step, about the joint's origin, world axes.
  ForceTorque wrench() const;
  /// Stores an effort for the next step.
  void add_effort(double effort);
  /// Applies an effort to the bodies at once, without limits.
  void push(double effort) const;

  /// Prepares rows and efforts before a step.
  void prepare(const StepSettings& step);
  /// Tracks the position over many turns, after a step.
  void measure();
  void serialize(StateArchive& state);

 private:
  void make_drives(dWorldID world, const Joint& joint, const JointPlacement& placement);
  Eigen::Vector3d direction(std::size_t axis) const;
  void aim_drives();
  void apply_effort();

  const JointKind& kind_;
  bool inclined_ = false;  // two axes that are not at right angles
  JointFrames frames_;
  JointHandle joint_;
  JointHandle damper_;
  std::optional<JointDrive> drive_;
  std::optional<JointDrive> drive2_;
  double position_ = 0.0;
  double position2_ = 0.0;
  double effort_ = 0.0;
  std::vector<std::pair<dJointID, dJointFeedback>> feedback_;  // the engine keeps addresses in it
  Eigen::Vector3d arm_W_{0, 0, 0};                             // anchor to child's centre of mass
  ForceTorque applied_;                                        // efforts of the last step
};

/// Throws Error naming the joint if it cannot be simulated.
void check_joint(const Model& model, const Joint& joint);

}  // namespace ardee::physics
