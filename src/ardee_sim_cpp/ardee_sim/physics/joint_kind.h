// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "ardee_sim/core/pose.h"
#include "ardee_sim/description/model.h"
#include "ardee_sim/physics/ode_types.h"

namespace ardee::physics {

/// The two bodies of a joint, and the pose of the joint in them.
struct JointFrames {
  dBodyID child = nullptr;
  dBodyID parent = nullptr;
  Eigen::Vector3d axis_P{0, 0, 1};       // the first axis, fixed in the parent
  Eigen::Vector3d axis2_C{0, 0, 1};      // the second, fixed in the child
  Eigen::Vector3d axis2_P{0, 0, 1};      // the second in the parent, all joints at zero
  Eigen::Quaterniond q_PC0{1, 0, 0, 0};  // child in parent, all joints at zero
  Eigen::Vector3d anchor_P{0, 0, 0};
  Eigen::Vector3d anchor_C{0, 0, 0};

  Eigen::Vector3d axis_W() const;
  Eigen::Vector3d axis2_W() const;
  /// Position of the anchor fixed in the child.
  Eigen::Vector3d anchor_W() const;
  /// Angular velocity of the child relative to the parent, rad/s in the world's axes.
  Eigen::Vector3d relative_rate() const;
};

/// Initial anchor and axes of a joint in the world.
struct JointPlacement {
  Eigen::Vector3d anchor;
  Eigen::Vector3d axis;
  Eigen::Vector3d axis2;
};

/// Behaviour of one type of joint: one class per type, without state.
class JointKind {
 public:
  virtual ~JointKind() = default;

  /// Makes the engine's joint between the bodies at their present poses.
  virtual JointHandle make(dWorldID world, const JointFrames& frames,
                           const JointPlacement& placement) const = 0;
  /// Sets the anchor of the engine's joint again, after a shift of the bodies' frames within the
  /// bodies.
  virtual void set_anchor(dJointID joint, const JointFrames& frames) const = 0;
  /// Makes a row that brakes all motion of the joint, for types without axes.
  virtual JointHandle damper(dWorldID world, const JointFrames& frames, double damping) const;

  /// Number of axes that can be driven and measured: 0, 1 or 2.
  virtual std::size_t axes() const = 0;
  /// Whether the first axis moves along a line: m and N in place of rad and N m.
  virtual bool is_linear() const { return false; }
  /// Whether the first axis has limits.
  virtual bool is_limited() const { return true; }
  /// Throws Error if the cosine between two axes is not allowed; `what` begins the message.
  virtual void check_axes(double cosine, const Joint& joint, const std::string& what) const;

  /// Position of the first axis, rad within (-pi, pi] or m.
  virtual double position(const JointFrames& frames) const = 0;
  /// Position of the second axis if the first one is at `position`.
  virtual double position2(const JointFrames& frames, double position) const;
  /// Velocity of the first axis, measured along `direction_W`.
  virtual double velocity(const JointFrames& frames, const Eigen::Vector3d& direction_W) const;
  /// Motion of the child in the world for a change of the first axis' position.
  virtual Pose motion(const JointFrames& frames, double change) const;
  /// Applies an effort (N m or N) to the child, and the opposite one to the parent.
  virtual void push(const JointFrames& frames, const Eigen::Vector3d& effort_W) const;
};

/// |cos| up to which two axes count as at right angles.
constexpr double kRightAngle = 1e-3;

/// The kind of the joint's type. Throws Error, whose message begins with `what`, for a type without
/// a counterpart in the physics engine.
const JointKind& joint_kind(const Joint& joint, const std::string& what = "");

}  // namespace ardee::physics
