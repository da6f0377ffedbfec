// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/joints/joint_kind.h"

#include "ardee_sim/core/error.h"
#include "ardee_sim/physics/joints/joint_kinds.h"

namespace ardee::physics {

using Eigen::Quaterniond;
using Eigen::Vector3d;

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
