// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/joint_kind.h"

#include <cmath>

#include "ardee_sim/core/error.h"

namespace ardee::physics {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// The angle by which q turns about a unit axis, in (-pi, pi].
double twist_angle(const Quaterniond& q, const Vector3d& axis) {
  const double angle = 2.0 * std::atan2(q.vec().dot(axis), q.w());
  return std::remainder(angle, 2.0 * M_PI);
}

/// Turns about one axis, within limits or without.
class HingeJoint : public JointKind {
 public:
  explicit HingeJoint(bool is_limited) : is_limited_(is_limited) {}
  JointHandle make(dWorldID world, const JointFrames& frames,
                   const JointPlacement& placement) const override {
    JointHandle joint(dJointCreateHinge(world, nullptr));
    dJointAttach(joint.get(), frames.child, frames.parent);
    const auto& [anchor, axis, axis2] = placement;
    dJointSetHingeAnchor(joint.get(), anchor.x(), anchor.y(), anchor.z());
    dJointSetHingeAxis(joint.get(), axis.x(), axis.y(), axis.z());
    return joint;
  }
  void set_anchor(dJointID joint, const JointFrames& frames) const override {
    const Vector3d anchor = frames.anchor_W();
    dJointSetHingeAnchor(joint, anchor.x(), anchor.y(), anchor.z());
  }
  std::size_t axes() const override { return 1; }
  bool is_limited() const override { return is_limited_; }
  double position(const JointFrames& frames) const override {
    // q_PC = turn * q_PC0, with the turn about the axis in the parent.
    const Quaterniond q_WC = body_pose(frames.child).q;
    return twist_angle(body_pose(frames.parent).q.conjugate() * q_WC * frames.q_PC0.conjugate(),
                       frames.axis_P);
  }

 private:
  const bool is_limited_;
};

/// Slides along one axis.
class SliderJoint : public JointKind {
 public:
  JointHandle make(dWorldID world, const JointFrames& frames,
                   const JointPlacement& placement) const override {
    JointHandle joint(dJointCreateSlider(world, nullptr));
    dJointAttach(joint.get(), frames.child, frames.parent);
    const Vector3d& axis = placement.axis;
    dJointSetSliderAxis(joint.get(), axis.x(), axis.y(), axis.z());
    return joint;
  }
  void set_anchor(dJointID joint, const JointFrames& frames) const override {
    // The engine takes the child's place at the time when the axis is set as the slider's zero.
    const Pose X_WC = body_pose(frames.child);
    const Vector3d axis = frames.axis_W();
    set_body_pose(frames.child, {X_WC.p - position(frames) * axis, X_WC.q});
    dJointSetSliderAxis(joint, axis.x(), axis.y(), axis.z());
    set_body_pose(frames.child, X_WC);
  }
  std::size_t axes() const override { return 1; }
  bool is_linear() const override { return true; }
  double position(const JointFrames& frames) const override {
    const Pose X_WP = body_pose(frames.parent);
    return (X_WP.inverse() * frames.anchor_W() - frames.anchor_P).dot(frames.axis_P);
  }
  double velocity(const JointFrames& frames, const Vector3d&) const override {
    const Vector3d anchor = frames.anchor_W();
    dVector3 v_child, v_parent;
    dBodyGetPointVel(frames.child, anchor.x(), anchor.y(), anchor.z(), v_child);
    dBodyGetPointVel(frames.parent, anchor.x(), anchor.y(), anchor.z(), v_parent);
    return (to_vector(v_child) - to_vector(v_parent)).dot(frames.axis_W());
  }
  Pose motion(const JointFrames& frames, double change) const override {
    return {change * frames.axis_W(), Quaterniond::Identity()};
  }
  void push(const JointFrames& frames, const Vector3d& effort_W) const override {
    const Vector3d anchor = frames.anchor_W();
    dBodyAddForceAtPos(frames.child, effort_W.x(), effort_W.y(), effort_W.z(), anchor.x(),
                       anchor.y(), anchor.z());
    dBodyAddForceAtPos(frames.parent, -effort_W.x(), -effort_W.y(), -effort_W.z(), anchor.x(),
                       anchor.y(), anchor.z());
  }
};

/// Turns about all axes; none of them is driven.
class BallJoint : public JointKind {
 public:
  JointHandle make(dWorldID world, const JointFrames& frames,
                   const JointPlacement& placement) const override {
    JointHandle joint(dJointCreateBall(world, nullptr));
    dJointAttach(joint.get(), frames.child, frames.parent);
    const Vector3d& anchor = placement.anchor;
    dJointSetBallAnchor(joint.get(), anchor.x(), anchor.y(), anchor.z());
    return joint;
  }
  void set_anchor(dJointID joint, const JointFrames& frames) const override {
    const Vector3d anchor = frames.anchor_W();
    dJointSetBallAnchor(joint, anchor.x(), anchor.y(), anchor.z());
  }
  JointHandle damper(dWorldID world, const JointFrames& frames, double damping) const override {
    constexpr double kLeastDamping = 1e-12;  // N m s
    if (damping < kLeastDamping) return {};
    JointHandle damper(dJointCreateAMotor(world, nullptr));
    dJointAttach(damper.get(), frames.child, frames.parent);
    dJointSetAMotorMode(damper.get(), dAMotorUser);
    dJointSetAMotorNumAxes(damper.get(), 3);
    for (int i = 0; i < 3; ++i) {
      const Vector3d unit = Vector3d::Unit(i);
      dJointSetAMotorAxis(damper.get(), i, 0, unit.x(), unit.y(), unit.z());
      dJointSetAMotorParam(damper.get(), dParamFMax + dParamGroup * i, dInfinity);
      dJointSetAMotorParam(damper.get(), dParamCFM + dParamGroup * i, 1.0 / damping);
    }
    return damper;
  }
  std::size_t axes() const override { return 0; }
  double position(const JointFrames&) const override { return 0.0; }
  double velocity(const JointFrames&, const Vector3d&) const override { return 0.0; }
};

/// Holds the child at its initial pose in the parent.
class FixedJoint : public JointKind {
 public:
  JointHandle make(dWorldID world, const JointFrames& frames,
                   const JointPlacement&) const override {
    JointHandle joint(dJointCreateFixed(world, nullptr));
    dJointAttach(joint.get(), frames.child, frames.parent);
    dJointSetFixed(joint.get());
    return joint;
  }
  void set_anchor(dJointID joint, const JointFrames&) const override { dJointSetFixed(joint); }
  std::size_t axes() const override { return 0; }
  double position(const JointFrames&) const override { return 0.0; }
  double velocity(const JointFrames&, const Vector3d&) const override { return 0.0; }
};

/// Turns about a first axis, fixed in the parent, and a second, fixed in the child.
class TwoAxesJoint : public JointKind {
 public:
  std::size_t axes() const override { return 2; }
  void check_axes(double cosine, const Joint& joint, const std::string& what) const override {
    if (std::abs(cosine) > 1.0 - 1e-6) {
      throw Error(joint.source, what + "found two axes along one line");
    }
  }
  double position(const JointFrames& frames) const override {
    // The first axis alone moves the second.
    const Vector3d turned =
        body_pose(frames.parent).q.conjugate() * (body_pose(frames.child).q * frames.axis2_C);
    const Vector3d start = frames.axis2_P - frames.axis2_P.dot(frames.axis_P) * frames.axis_P;
    return std::atan2(frames.axis_P.cross(start).dot(turned), start.dot(turned));
  }
  double position2(const JointFrames& frames, double position) const override {
    // Turn of the child relative to the first axis: q_PC = turn1 * turn2 * q_PC0.
    const Quaterniond q_PC = body_pose(frames.parent).q.conjugate() * body_pose(frames.child).q;
    const Quaterniond turn1(Eigen::AngleAxisd(position, frames.axis_P));
    return twist_angle(turn1.conjugate() * q_PC * frames.q_PC0.conjugate(), frames.axis2_P);
  }
};

/// Two axes at right angles.
class UniversalJoint : public TwoAxesJoint {
 public:
  JointHandle make(dWorldID world, const JointFrames& frames,
                   const JointPlacement& placement) const override {
    JointHandle joint(dJointCreateUniversal(world, nullptr));
    dJointAttach(joint.get(), frames.parent, frames.child);
    const auto& [anchor, axis, axis2] = placement;
    dJointSetUniversalAnchor(joint.get(), anchor.x(), anchor.y(), anchor.z());
    dJointSetUniversalAxis1(joint.get(), axis.x(), axis.y(), axis.z());
    dJointSetUniversalAxis2(joint.get(), axis2.x(), axis2.y(), axis2.z());
    return joint;
  }
  void set_anchor(dJointID joint, const JointFrames& frames) const override {
    const Vector3d anchor = frames.anchor_W();
    dJointSetUniversalAnchor(joint, anchor.x(), anchor.y(), anchor.z());
  }
  void check_axes(double cosine, const Joint& joint, const std::string& what) const override {
    if (std::abs(cosine) > kRightAngle) {
      throw Error(joint.source, what + "found two axes that are not at right angles");
    }
  }
};

/// Two axes at any angle: a steered wheel.
class Hinge2Joint : public TwoAxesJoint {
 public:
  JointHandle make(dWorldID world, const JointFrames& frames,
                   const JointPlacement& placement) const override {
    JointHandle joint(dJointCreateHinge2(world, nullptr));
    dJointAttach(joint.get(), frames.parent, frames.child);
    const auto& [anchor, axis, axis2] = placement;
    dJointSetHinge2Anchor(joint.get(), anchor.x(), anchor.y(), anchor.z());
    dJointSetHinge2Axes(joint.get(), axis.data(), axis2.data());
    return joint;
  }
  void set_anchor(dJointID joint, const JointFrames& frames) const override {
    const Vector3d anchor = frames.anchor_W();
    dJointSetHinge2Anchor(joint, anchor.x(), anchor.y(), anchor.z());
  }
};

}  // namespace

Vector3d JointFrames::axis_W() const { return body_pose(parent).q * axis_P; }

Vector3d JointFrames::axis2_W() const { return body_pose(child).q * axis2_C; }

Vector3d JointFrames::anchor_W() const { return body_pose(child) * anchor_C; }

Vector3d JointFrames::relative_rate() const {
  return to_vector(dBodyGetAngularVel(child)) - to_vector(dBodyGetAngularVel(parent));
}

JointHandle JointKind::damper(dWorldID, const JointFrames&, double) const { return {}; }

void JointKind::check_axes(double, const Joint&, const std::string&) const {}

double JointKind::position2(const JointFrames&, double) const { return 0.0; }

double JointKind::velocity(const JointFrames& frames, const Vector3d& direction_W) const {
  return frames.relative_rate().dot(direction_W);
}

Pose JointKind::motion(const JointFrames& frames, double change) const {
  const Quaterniond turn(Eigen::AngleAxisd(change, frames.axis_W()));
  const Vector3d anchor = body_pose(frames.parent) * frames.anchor_P;
  return {anchor - turn * anchor, turn};
}

void JointKind::push(const JointFrames& frames, const Vector3d& effort_W) const {
  dBodyAddTorque(frames.child, effort_W.x(), effort_W.y(), effort_W.z());
  dBodyAddTorque(frames.parent, -effort_W.x(), -effort_W.y(), -effort_W.z());
}

const JointKind& joint_kind(const Joint& joint, const std::string& what) {
  static const FixedJoint fixed;
  static const HingeJoint revolute(true);
  static const HingeJoint continuous(false);
  static const SliderJoint prismatic;
  static const BallJoint ball;
  static const UniversalJoint universal;
  static const Hinge2Joint revolute2;
  switch (joint.type) {
    case JointType::kFixed:
      return fixed;
    case JointType::kRevolute:
      return revolute;
    case JointType::kContinuous:
      return continuous;
    case JointType::kPrismatic:
      return prismatic;
    case JointType::kBall:
      return ball;
    case JointType::kUniversal:
      return universal;
    case JointType::kRevolute2:
      return revolute2;
    case JointType::kScrew:
      break;
  }
  throw Error(joint.source,
              what + "found type screw, which the physics engine has no counterpart for");
}

}  // namespace ardee::physics
