// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "ardee_sim/description/model.h"
#include "ardee_sim/physics/contact.h"
#include "ardee_sim/physics/joint_drive.h"
#include "ardee_sim/physics/joints/joint_kind.h"
#include "ardee_sim/physics/ode_types.h"

namespace ardee::physics {

/// A joint between two bodies, with the bodies standing as all joints at zero when it is made.
/// Positions and velocities are those of the child against the parent about the first axis, as SDF
/// and URDF count them.
class ModelJoint {
 public:
  /// X_WJ: the joint's frame in the world.
  ModelJoint(dWorldID world, const Joint& joint, dBodyID child, dBodyID parent, const Pose& X_WJ);

  /// False of a ball joint and one that is fixed.
  bool has_position() const { return kind_.axes() > 0; }
  double position() const { return position_; }
  double velocity() const;
  /// Where the child has to go, as a motion of the world, for the first axis to stand at `position`
  /// within its limits.
  Pose motion_to(double position) const;
  /// The position is taken as it is from now on, whatever turns it has made.
  void set_position(double position) { position_ = position; }
  /// The position is measured anew: of the turns that give it the one within the limits.
  void take_position();
  double clamp(double position) const;

  /// Axes that can be driven; none of a ball joint, or between bodies that nothing moves.
  std::size_t axes() const { return drive2_ ? 2 : drive_ ? 1 : 0; }
  /// Whether a motor acts on one of them.
  bool is_driven() const;
  JointDrive& drive(std::size_t axis) { return axis == 0 ? drive_.value() : drive2_.value(); }
  /// The frames of the bodies have moved within them by so much, in their own axes.
  void shift_frames(const Eigen::Vector3d& child_C, const Eigen::Vector3d& parent_P);
  /// From now on each step's wrench is kept.
  void keep_wrench();
  /// What the child applied to the joint in the last step, about the joint's origin, world axes.
  ForceTorque wrench() const;
  /// Kept for the next step.
  void add_effort(double effort);
  /// Acts on the bodies at once, whatever the limits.
  void push(double effort) const;

  /// Before a step: rows, efforts.
  void prepare(const StepSettings& step);
  /// After a step: follows the position over many turns.
  void measure();

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
