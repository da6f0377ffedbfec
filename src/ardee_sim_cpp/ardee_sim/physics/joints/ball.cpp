// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/joints/joint_kinds.h"

namespace ardee::physics {
namespace {

constexpr double kLeastDamping = 1e-12;  // N m s

}  // namespace

JointHandle BallJoint::make(dWorldID world, const JointFrames& frames,
                            const JointPlacement& placement) const {
  JointHandle joint(dJointCreateBall(world, nullptr));
  dJointAttach(joint.get(), frames.child, frames.parent);
  const Eigen::Vector3d& anchor = placement.anchor;
  dJointSetBallAnchor(joint.get(), anchor.x(), anchor.y(), anchor.z());
  return joint;
}

void BallJoint::set_anchor(dJointID joint, const JointFrames& frames) const {
  const Eigen::Vector3d anchor = frames.anchor_W();
  dJointSetBallAnchor(joint, anchor.x(), anchor.y(), anchor.z());
}

JointHandle BallJoint::damper(dWorldID world, const JointFrames& frames, double damping) const {
  if (damping < kLeastDamping) return {};
  JointHandle damper(dJointCreateAMotor(world, nullptr));
  dJointAttach(damper.get(), frames.child, frames.parent);
  dJointSetAMotorMode(damper.get(), dAMotorUser);
  dJointSetAMotorNumAxes(damper.get(), 3);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(i);
    dJointSetAMotorAxis(damper.get(), i, 0, unit.x(), unit.y(), unit.z());
    dJointSetAMotorParam(damper.get(), dParamFMax + dParamGroup * i, dInfinity);
    dJointSetAMotorParam(damper.get(), dParamCFM + dParamGroup * i, 1.0 / damping);
  }
  return damper;
}

double BallJoint::position(const JointFrames&) const { return 0.0; }

double BallJoint::velocity(const JointFrames&, const Eigen::Vector3d&) const { return 0.0; }

}  // namespace ardee::physics
