// SPDX-License-Identifier: MIT
#include <cmath>

#include "ardee_sim/physics/joints/joint_kinds.h"

namespace ardee::physics {

double twist_angle(const Eigen::Quaterniond& q, const Eigen::Vector3d& axis) {
  const double angle = 2.0 * std::atan2(q.vec().dot(axis), q.w());
  return std::remainder(angle, 2.0 * M_PI);
}

JointHandle HingeJoint::make(dWorldID world, const JointFrames& frames,
                             const JointPlacement& placement) const {
  JointHandle joint(dJointCreateHinge(world, nullptr));
  dJointAttach(joint.get(), frames.child, frames.parent);
  const auto& [anchor, axis, axis2] = placement;
  dJointSetHingeAnchor(joint.get(), anchor.x(), anchor.y(), anchor.z());
  dJointSetHingeAxis(joint.get(), axis.x(), axis.y(), axis.z());
  return joint;
}

void HingeJoint::set_anchor(dJointID joint, const JointFrames& frames) const {
  const Eigen::Vector3d anchor = frames.anchor_W();
  dJointSetHingeAnchor(joint, anchor.x(), anchor.y(), anchor.z());
}

double HingeJoint::position(const JointFrames& frames) const {
  // q_PC = turn * q_PC0, with the turn about the axis in the parent.
  const Eigen::Quaterniond q_WC = body_pose(frames.child).q;
  return twist_angle(body_pose(frames.parent).q.conjugate() * q_WC * frames.q_PC0.conjugate(),
                     frames.axis_P);
}

}  // namespace ardee::physics
