// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/joints/joint_kinds.h"

namespace ardee::physics {

JointHandle FixedJoint::make(dWorldID world, const JointFrames& frames,
                             const JointPlacement&) const {
  JointHandle joint(dJointCreateFixed(world, nullptr));
  dJointAttach(joint.get(), frames.child, frames.parent);
  dJointSetFixed(joint.get());
  return joint;
}

void FixedJoint::set_anchor(dJointID joint, const JointFrames&) const { dJointSetFixed(joint); }

double FixedJoint::position(const JointFrames&) const { return 0.0; }

double FixedJoint::velocity(const JointFrames&, const Eigen::Vector3d&) const { return 0.0; }

}  // namespace ardee::physics
