// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "ardee_sim/core/pose.h"
#include "ardee_sim/description/model.h"
#include "ardee_sim/physics/ode_types.h"

namespace ardee::physics {

/// The two bodies of a joint, and how the joint lies in them.
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
  /// The anchor as the child carries it.
  Eigen::Vector3d anchor_W() const;
  /// Of the child against the parent, rad/s in the world's axes.
  Eigen::Vector3d relative_rate() const;
};

/// Where a joint lies in the world when it is made.
struct JointPlacement {
  Eigen::Vector3d anchor;
  Eigen::Vector3d axis;
  Eigen::Vector3d axis2;
};

/// What one type of joint does in its own way: one class a type, without state.
class JointKind {
 public:
  virtual ~JointKind() = default;

  /// The engine's joint between the bodies where they stand.
  virtual JointHandle make(dWorldID world, const JointFrames& frames,
                           const JointPlacement& placement) const = 0;
  /// Tells the engine's joint its anchor anew, after the bodies' frames have moved within them.
  virtual void set_anchor(dJointID joint, const JointFrames& frames) const = 0;
  /// A row that brakes all motion of the joint, of types without axes.
  virtual JointHandle damper(dWorldID world, const JointFrames& frames, double damping) const;

  /// Axes that can be driven and measured: 0, 1 or 2.
  virtual std::size_t axes() const = 0;
  /// Whether the first axis moves along a line: m and N in place of rad and N m.
  virtual bool is_linear() const { return false; }
  /// Whether the first axis has limits.
  virtual bool is_limited() const { return true; }
  /// Throws Error if two axes may not lie so, by the cosine between them; `what` begins the
  /// message.
  virtual void check_axes(double cosine, const Joint& joint, const std::string& what) const;

  /// Of the first axis, rad within (-pi, pi] or m.
  virtual double position(const JointFrames& frames) const = 0;
  /// Of the second axis, the first standing at `position`.
  virtual double position2(const JointFrames& frames, double position) const;
  /// Of the first axis; `direction_W` is that along which it is measured.
  virtual double velocity(const JointFrames& frames, const Eigen::Vector3d& direction_W) const;
  /// How the child moves in the world as the first axis goes on by `change`.
  virtual Pose motion(const JointFrames& frames, double change) const;
  /// Pushes the child, and the parent back, by N m or N.
  virtual void push(const JointFrames& frames, const Eigen::Vector3d& effort_W) const;
};

/// That of the joint's type. Throws Error, which `what` begins, for a type that the physics engine
/// has no counterpart for.
const JointKind& joint_kind(const Joint& joint, const std::string& what = "");

}  // namespace ardee::physics
