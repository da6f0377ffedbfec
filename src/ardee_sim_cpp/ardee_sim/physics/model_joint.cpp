// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/model_joint.h"

#include <cmath>
#include <sstream>

#include "ardee_sim/core/error.h"
#include "ardee_sim/description/bounds.h"

namespace ardee::physics {
namespace {

using Eigen::Vector3d;

/// `angle` with whole turns added to lie nearest to `near`.
double unwrap(double angle, double near) { return near + std::remainder(angle - near, 2.0 * M_PI); }

void check_axis(const Model& model, const Joint& joint, const JointAxis& axis) {
  std::ostringstream what;
  what << "joint '" << joint.name << "' of model '" << model.name << "': ";
  if (!axis.axis.allFinite() || axis.axis.norm() < 1e-9) {
    throw Error(joint.source, what.str() + "found an axis of no length, expected a unit vector");
  }
  if (!(axis.lower <= axis.upper)) {
    what << "found limits " << axis.lower << " to " << axis.upper
         << ", expected the lower not above the upper";
    throw Error(joint.source, what.str());
  }
  const double numbers[] = {axis.damping, axis.friction, axis.spring_stiffness};
  for (const double number : numbers) {
    if (bounds::kJointCoefficient.holds(number)) continue;
    what << "found damping, friction or stiffness " << number << ", expected one in [0, "
         << bounds::kJointCoefficient.high << "]";
    throw Error(joint.source, what.str());
  }
  if (!bounds::kJointReference.holds(axis.spring_reference) || !(axis.effort >= 0.0) ||
      !(axis.velocity >= 0.0)) {
    throw Error(joint.source,
                what.str() +
                    "found a reference that is not finite or a negative limit of effort or "
                    "velocity");
  }
}

JointProperties properties_of(const JointAxis& axis, const Joint& joint) {
  JointProperties made;
  made.lower = axis.lower;
  made.upper = axis.upper;
  made.max_effort = axis.effort;
  made.max_velocity = axis.velocity;
  made.friction = axis.friction;
  made.spring = {axis.spring_stiffness, axis.damping, axis.spring_reference};
  made.stop_erp = joint.stop_erp;
  made.stop_cfm = joint.stop_cfm;
  return made;
}

}  // namespace

void check_joint(const Model& model, const Joint& joint) {
  const std::string what = "joint '" + joint.name + "' of model '" + model.name + "': ";
  const JointKind& kind = joint_kind(joint, what);
  if (!joint.X_CJ.is_finite()) throw Error(joint.source, what + "found a pose that is not finite");
  if (kind.axes() > 0) check_axis(model, joint, joint.axis);
  if (kind.axes() < 2) return;
  check_axis(model, joint, joint.axis2);
  kind.check_axes(joint.axis.axis.normalized().dot(joint.axis2.axis.normalized()), joint, what);
}

ModelJoint::ModelJoint(dWorldID world, const Joint& joint, dBodyID child, dBodyID parent,
                       const Pose& X_WJ)
    : kind_(joint_kind(joint)) {
  const Pose X_WC = body_pose(child), X_WP = body_pose(parent);
  const bool has_two_axes = kind_.axes() == 2;
  JointPlacement placement;
  placement.anchor = X_WJ.p;
  placement.axis = X_WJ.q * joint.axis.axis.normalized();
  placement.axis2 =
      has_two_axes ? Vector3d(X_WJ.q * joint.axis2.axis.normalized()) : placement.axis;
  inclined_ = has_two_axes && std::abs(placement.axis.dot(placement.axis2)) > kRightAngle;
  frames_.child = child;
  frames_.parent = parent;
  frames_.axis_P = X_WP.q.conjugate() * placement.axis;
  frames_.axis2_C = X_WC.q.conjugate() * placement.axis2;
  frames_.axis2_P = X_WP.q.conjugate() * placement.axis2;
  frames_.q_PC0 = X_WP.q.conjugate() * X_WC.q;
  frames_.anchor_P = X_WP.inverse() * X_WJ.p;
  frames_.anchor_C = X_WC.inverse() * X_WJ.p;
  joint_ = kind_.make(world, frames_, placement);
  if (dBodyIsKinematic(child) && dBodyIsKinematic(parent)) {
    dJointDisable(joint_.get());  // neither body moves
    return;
  }
  make_drives(world, joint, placement);
}

void ModelJoint::make_drives(dWorldID world, const Joint& joint, const JointPlacement& placement) {
  damper_ = kind_.damper(world, frames_, joint.axis.damping);
  if (kind_.axes() == 0) return;
  JointProperties first = properties_of(joint.axis, joint);
  if (!kind_.is_limited()) {
    first.lower = -dInfinity;
    first.upper = dInfinity;
  }
  if (kind_.is_linear()) {
    drive_ = JointDrive::linear(world, frames_.child, frames_.parent, joint_.get(), placement.axis,
                                first);
  } else {
    drive_ = JointDrive::rotational(world, frames_.child, frames_.parent, 2, placement.axis, first);
  }
  if (kind_.axes() == 2) {
    drive2_ = JointDrive::rotational(world, frames_.child, frames_.parent, 1, placement.axis2,
                                     properties_of(joint.axis2, joint));
  }
}

/// The direction along which a turn of one axis is measured and driven without an effect on the
/// other axis: for two axes that are not at right angles, the direction at right angles to the
/// other axis, with component 1 along its own.
Vector3d ModelJoint::direction(std::size_t axis) const {
  if (!inclined_) return axis == 0 ? frames_.axis_W() : frames_.axis2_W();
  const Vector3d own = axis == 0 ? frames_.axis_W() : frames_.axis2_W();
  const Vector3d other = axis == 0 ? frames_.axis2_W() : frames_.axis_W();
  const double cosine = own.dot(other);
  return (own - cosine * other) / (1.0 - cosine * cosine);
}

void ModelJoint::aim_drives() {
  for (std::size_t axis = 0; axis < axes(); ++axis) {
    const Vector3d along = direction(axis);
    drive(axis).aim(along, 1.0 / along.norm());
  }
}

double ModelJoint::velocity() const { return kind_.velocity(frames_, direction(0)); }

double ModelJoint::clamp(double position) const { return drive_ ? drive_->clamp(position) : 0.0; }

Pose ModelJoint::motion_to(double position) const {
  return kind_.motion(frames_, clamp(position) - position_);
}

void ModelJoint::shift_frames(const Vector3d& child_C, const Vector3d& parent_P) {
  frames_.anchor_C -= child_C;
  frames_.anchor_P -= parent_P;
  kind_.set_anchor(joint_.get(), frames_);
}

void ModelJoint::keep_wrench() {
  if (!feedback_.empty()) return;
  std::vector<dJointID> all{joint_.get()};
  if (damper_) all.push_back(damper_.get());
  for (const auto* drive : {&drive_, &drive2_}) {
    if (!*drive) continue;
    for (dJointID joint : (*drive)->joints()) all.push_back(joint);
  }
  for (dJointID joint : all) feedback_.emplace_back(joint, dJointFeedback{});
  for (auto& [joint, feedback] : feedback_) dJointSetFeedback(joint, &feedback);
}

ForceTorque ModelJoint::wrench() const {
  ForceTorque on_child = applied_;
  for (const auto& [joint, feedback] : feedback_) {
    const bool is_first = dJointGetBody(joint, 0) == frames_.child;
    const Vector3d force = to_vector(is_first ? feedback.f1 : feedback.f2);
    on_child.force += force;
    on_child.torque += to_vector(is_first ? feedback.t1 : feedback.t2) + arm_W_.cross(force);
  }
  return {-on_child.force, -on_child.torque};
}

bool ModelJoint::is_driven() const {
  return (drive_ && drive_->motor().max_effort > 0.0) ||
         (drive2_ && drive2_->motor().max_effort > 0.0);
}

void ModelJoint::add_effort(double effort) { effort_ += effort; }

void ModelJoint::apply_effort() {
  applied_ = {};
  if (effort_ == 0.0 || !drive_) return;
  const double along = drive_->clamp_effort(effort_, velocity());
  (kind_.is_linear() ? applied_.force : applied_.torque) = along * direction(0);
  push(along);
  effort_ = 0.0;
}

void ModelJoint::push(double along) const { kind_.push(frames_, along * direction(0)); }

void ModelJoint::prepare(const StepSettings& step) {
  if (inclined_) aim_drives();
  if (drive_) drive_->prepare(position_, velocity(), step);
  if (drive2_) drive2_->prepare(position2_, frames_.relative_rate().dot(direction(1)), step);
  apply_effort();
  if (feedback_.empty()) return;
  const Pose X_WC = body_pose(frames_.child);
  arm_W_ = X_WC.p - X_WC * frames_.anchor_C;
}

void ModelJoint::serialize(StateArchive& state) {
  for (auto* drive : {&drive_, &drive2_}) {
    if (*drive) state(**drive);
  }
  bool has_feedback = !feedback_.empty();
  state(position_, position2_, effort_, arm_W_, applied_, has_feedback);
  if (has_feedback) keep_wrench();
  for (auto& [joint, feedback] : feedback_) state(feedback);
}

void ModelJoint::take_position() {
  position_ = kind_.position(frames_);
  if (kind_.is_linear()) return;
  for (const double turned : {position_ + 2.0 * M_PI, position_ - 2.0 * M_PI}) {
    if (clamp(position_) != position_ && clamp(turned) == turned) position_ = turned;
  }
  if (drive2_) position2_ = kind_.position2(frames_, position_);
}

void ModelJoint::measure() {
  const double now = kind_.position(frames_);
  position_ = kind_.is_linear() ? now : unwrap(now, position_);
  if (drive2_) position2_ = unwrap(kind_.position2(frames_, position_), position2_);
}

}  // namespace ardee::physics
