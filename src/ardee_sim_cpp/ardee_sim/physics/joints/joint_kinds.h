// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/physics/joints/joint_kind.h"

namespace ardee::physics {

/// Turns about one axis, within limits or without.
class HingeJoint : public JointKind {
 public:
  explicit HingeJoint(bool is_limited) : is_limited_(is_limited) {}
  JointHandle make(dWorldID world, const JointFrames& frames,
                   const JointPlacement& placement) const override;
  void set_anchor(dJointID joint, const JointFrames& frames) const override;
  std::size_t axes() const override { return 1; }
  bool is_limited() const override { return is_limited_; }
  double position(const JointFrames& frames) const override;

 private:
  const bool is_limited_;
};

/// Slides along one axis.
class SliderJoint : public JointKind {
 public:
  JointHandle make(dWorldID world, const JointFrames& frames,
                   const JointPlacement& placement) const override;
  void set_anchor(dJointID joint, const JointFrames& frames) const override;
  std::size_t axes() const override { return 1; }
  bool is_linear() const override { return true; }
  double position(const JointFrames& frames) const override;
  double velocity(const JointFrames& frames, const Eigen::Vector3d& direction_W) const override;
  Pose motion(const JointFrames& frames, double change) const override;
  void push(const JointFrames& frames, const Eigen::Vector3d& effort_W) const override;
};

/// Turns about all axes; none of them is driven.
class BallJoint : public JointKind {
 public:
  JointHandle make(dWorldID world, const JointFrames& frames,
                   const JointPlacement& placement) const override;
  void set_anchor(dJointID joint, const JointFrames& frames) const override;
  JointHandle damper(dWorldID world, const JointFrames& frames, double damping) const override;
  std::size_t axes() const override { return 0; }
  double position(const JointFrames& frames) const override;
  double velocity(const JointFrames& frames, const Eigen::Vector3d& direction_W) const override;
};

/// Holds the child at its initial pose in the parent.
class FixedJoint : public JointKind {
 public:
  JointHandle make(dWorldID world, const JointFrames& frames,
                   const JointPlacement& placement) const override;
  void set_anchor(dJointID joint, const JointFrames& frames) const override;
  std::size_t axes() const override { return 0; }
  double position(const JointFrames& frames) const override;
  double velocity(const JointFrames& frames, const Eigen::Vector3d& direction_W) const override;
};

/// Turns about a first axis, fixed in the parent, and a second, fixed in the child.
class TwoAxesJoint : public JointKind {
 public:
  std::size_t axes() const override { return 2; }
  void check_axes(double cosine, const Joint& joint, const std::string& what) const override;
  double position(const JointFrames& frames) const override;
  double position2(const JointFrames& frames, double position) const override;
};

/// Two axes at right angles.
class UniversalJoint : public TwoAxesJoint {
 public:
  JointHandle make(dWorldID world, const JointFrames& frames,
                   const JointPlacement& placement) const override;
  void set_anchor(dJointID joint, const JointFrames& frames) const override;
  void check_axes(double cosine, const Joint& joint, const std::string& what) const override;
};

/// Two axes at any angle: a steered wheel.
class Hinge2Joint : public TwoAxesJoint {
 public:
  JointHandle make(dWorldID world, const JointFrames& frames,
                   const JointPlacement& placement) const override;
  void set_anchor(dJointID joint, const JointFrames& frames) const override;
};

/// |cos| up to which two axes count as at right angles.
constexpr double kRightAngle = 1e-3;

/// The angle by which q turns about a unit axis, in (-pi, pi].
double twist_angle(const Eigen::Quaterniond& q, const Eigen::Vector3d& axis);

}  // namespace ardee::physics
