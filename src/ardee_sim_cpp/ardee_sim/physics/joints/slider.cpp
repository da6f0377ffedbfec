// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/joints/joint_kinds.h"

namespace ardee::physics {

using Eigen::Vector3d;

JointHandle SliderJoint::make(dWorldID world, const JointFrames& frames,
                              const JointPlacement& placement) const {
  JointHandle joint(dJointCreateSlider(world, nullptr));
  dJointAttach(joint.get(), frames.child, frames.parent);
  const Vector3d& axis = placement.axis;
  dJointSetSliderAxis(joint.get(), axis.x(), axis.y(), axis.z());
  return joint;
}

void SliderJoint::set_anchor(dJointID joint, const JointFrames& frames) const {
  // The engine takes the child's place at the time when the axis is set as the slider's zero.
  const Pose X_WC = body_pose(frames.child);
  const Vector3d axis = frames.axis_W();
  set_body_pose(frames.child, {X_WC.p - position(frames) * axis, X_WC.q});
  dJointSetSliderAxis(joint, axis.x(), axis.y(), axis.z());
  set_body_pose(frames.child, X_WC);
}

double SliderJoint::position(const JointFrames& frames) const {
  const Pose X_WP = body_pose(frames.parent);
  return (X_WP.inverse() * frames.anchor_W() - frames.anchor_P).dot(frames.axis_P);
}

double SliderJoint::velocity(const JointFrames& frames, const Vector3d&) const {
  const Vector3d anchor = frames.anchor_W();
  dVector3 v_child, v_parent;
  dBodyGetPointVel(frames.child, anchor.x(), anchor.y(), anchor.z(), v_child);
  dBodyGetPointVel(frames.parent, anchor.x(), anchor.y(), anchor.z(), v_parent);
  return (to_vector(v_child) - to_vector(v_parent)).dot(frames.axis_W());
}

Pose SliderJoint::motion(const JointFrames& frames, double change) const {
  return {change * frames.axis_W(), Eigen::Quaterniond::Identity()};
}

void SliderJoint::push(const JointFrames& frames, const Vector3d& effort_W) const {
  const Vector3d anchor = frames.anchor_W();
  dBodyAddForceAtPos(frames.child, effort_W.x(), effort_W.y(), effort_W.z(), anchor.x(), anchor.y(),
                     anchor.z());
  dBodyAddForceAtPos(frames.parent, -effort_W.x(), -effort_W.y(), -effort_W.z(), anchor.x(),
                     anchor.y(), anchor.z());
}

}  // namespace ardee::physics
