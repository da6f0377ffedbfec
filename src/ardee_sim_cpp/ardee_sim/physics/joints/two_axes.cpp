// SPDX-License-Identifier: MIT
#include <cmath>

#include "ardee_sim/core/error.h"
#include "ardee_sim/physics/joints/joint_kinds.h"

namespace ardee::physics {

using Eigen::Quaterniond;
using Eigen::Vector3d;

void TwoAxesJoint::check_axes(double cosine, const Joint& joint, const std::string& what) const {
  if (std::abs(cosine) > 1.0 - 1e-6) {
    throw Error(joint.source, what + "found two axes along one line");
  }
}

double TwoAxesJoint::position(const JointFrames& frames) const {
  // The first axis alone moves the second.
  const Vector3d turned =
      body_pose(frames.parent).q.conjugate() * (body_pose(frames.child).q * frames.axis2_C);
  const Vector3d start = frames.axis2_P - frames.axis2_P.dot(frames.axis_P) * frames.axis_P;
  return std::atan2(frames.axis_P.cross(start).dot(turned), start.dot(turned));
}

double TwoAxesJoint::position2(const JointFrames& frames, double position) const {
  // Turn of the child relative to the first axis: q_PC = turn1 * turn2 * q_PC0.
  const Quaterniond q_PC = body_pose(frames.parent).q.conjugate() * body_pose(frames.child).q;
  const Quaterniond turn1(Eigen::AngleAxisd(position, frames.axis_P));
  return twist_angle(turn1.conjugate() * q_PC * frames.q_PC0.conjugate(), frames.axis2_P);
}

JointHandle UniversalJoint::make(dWorldID world, const JointFrames& frames,
                                 const JointPlacement& placement) const {
  JointHandle joint(dJointCreateUniversal(world, nullptr));
  dJointAttach(joint.get(), frames.parent, frames.child);
  const auto& [anchor, axis, axis2] = placement;
  dJointSetUniversalAnchor(joint.get(), anchor.x(), anchor.y(), anchor.z());
  dJointSetUniversalAxis1(joint.get(), axis.x(), axis.y(), axis.z());
  dJointSetUniversalAxis2(joint.get(), axis2.x(), axis2.y(), axis2.z());
  return joint;
}

void UniversalJoint::set_anchor(dJointID joint, const JointFrames& frames) const {
  const Vector3d anchor = frames.anchor_W();
  dJointSetUniversalAnchor(joint, anchor.x(), anchor.y(), anchor.z());
}

void UniversalJoint::check_axes(double cosine, const Joint& joint, const std::string& what) const {
  if (std::abs(cosine) > kRightAngle) {
    throw Error(joint.source, what + "found two axes that are not at right angles");
  }
}

JointHandle Hinge2Joint::make(dWorldID world, const JointFrames& frames,
                              const JointPlacement& placement) const {
  JointHandle joint(dJointCreateHinge2(world, nullptr));
  dJointAttach(joint.get(), frames.parent, frames.child);
  const auto& [anchor, axis, axis2] = placement;
  dJointSetHinge2Anchor(joint.get(), anchor.x(), anchor.y(), anchor.z());
  dJointSetHinge2Axes(joint.get(), axis.data(), axis2.data());
  return joint;
}

void Hinge2Joint::set_anchor(dJointID joint, const JointFrames& frames) const {
  const Vector3d anchor = frames.anchor_W();
  dJointSetHinge2Anchor(joint, anchor.x(), anchor.y(), anchor.z());
}

}  // namespace ardee::physics
