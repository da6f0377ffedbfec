// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/model_joint.h"

#include <cmath>
#include <sstream>

#include "ardee_sim/core/error.h"
#include "ardee_sim/description/bounds.h"

namespace ardee::physics {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kRightAngle = 1e-3;  // |cos| up to which two axes count as at right angles

bool has_two_axes(JointType type) {
  return type == JointType::kUniversal || type == JointType::kRevolute2;
}

/// The angle by which q turns about a unit axis, in (-pi, pi].
double twist_angle(const Quaterniond& q, const Vector3d& axis) {
  const double angle = 2.0 * std::atan2(q.vec().dot(axis), q.w());
  return std::remainder(angle, 2.0 * M_PI);
}

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
  const std::string name = "joint '" + joint.name + "' of model '" + model.name + "': ";
  if (joint.type == JointType::kScrew) {
    throw Error(joint.source,
                name + "found type screw, which the physics engine has no counterpart for");
  }
  if (!joint.X_CJ.is_finite()) throw Error(joint.source, name + "found a pose that is not finite");
  if (joint.type == JointType::kFixed || joint.type == JointType::kBall) return;
  check_axis(model, joint, joint.axis);
  if (!has_two_axes(joint.type)) return;
  check_axis(model, joint, joint.axis2);
  const double cosine = joint.axis.axis.normalized().dot(joint.axis2.axis.normalized());
  if (joint.type == JointType::kUniversal && std::abs(cosine) > kRightAngle) {
    throw Error(joint.source, name + "found two axes that are not at right angles");
  }
  if (std::abs(cosine) > 1.0 - 1e-6) {
    throw Error(joint.source, name + "found two axes along one line");
  }
}

ModelJoint::ModelJoint(dWorldID world, const Joint& joint, dBodyID child, dBodyID parent,
                       const Pose& X_WJ)
    : type_(joint.type), child_(child), parent_(parent) {
  const Pose X_WC = body_pose(child), X_WP = body_pose(parent);
  const Vector3d axis_W = X_WJ.q * joint.axis.axis.normalized();
  const Vector3d axis2_W =
      has_two_axes(type_) ? Vector3d(X_WJ.q * joint.axis2.axis.normalized()) : axis_W;
  inclined_ = has_two_axes(type_) && std::abs(axis_W.dot(axis2_W)) > kRightAngle;
  axis_P_ = X_WP.q.conjugate() * axis_W;
  axis2_C_ = X_WC.q.conjugate() * axis2_W;
  axis2_P_ = X_WP.q.conjugate() * axis2_W;
  q_PC0_ = X_WP.q.conjugate() * X_WC.q;
  anchor_P_ = X_WP.inverse() * X_WJ.p;
  anchor_C_ = X_WC.inverse() * X_WJ.p;
  make_joint(world, X_WJ.p, axis_W, axis2_W);
  if (dBodyIsKinematic(child) && dBodyIsKinematic(parent)) {
    dJointDisable(joint_.get());  // nothing moves either of them
    return;
  }
  make_drives(world, joint, axis_W, axis2_W);
}

void ModelJoint::make_joint(dWorldID world, const Vector3d& anchor, const Vector3d& axis_W,
                            const Vector3d& axis2_W) {
  if (type_ == JointType::kPrismatic) {
    joint_.reset(dJointCreateSlider(world, nullptr));
    dJointAttach(joint_.get(), child_, parent_);
    dJointSetSliderAxis(joint_.get(), axis_W.x(), axis_W.y(), axis_W.z());
  } else if (type_ == JointType::kBall) {
    joint_.reset(dJointCreateBall(world, nullptr));
    dJointAttach(joint_.get(), child_, parent_);
    dJointSetBallAnchor(joint_.get(), anchor.x(), anchor.y(), anchor.z());
  } else if (type_ == JointType::kFixed) {
    joint_.reset(dJointCreateFixed(world, nullptr));
    dJointAttach(joint_.get(), child_, parent_);
    dJointSetFixed(joint_.get());
  } else if (type_ == JointType::kRevolute2) {
    // The first axis is fixed in the parent, the second in the child, here and in a universal
    // joint.
    joint_.reset(dJointCreateHinge2(world, nullptr));
    dJointAttach(joint_.get(), parent_, child_);
    dJointSetHinge2Anchor(joint_.get(), anchor.x(), anchor.y(), anchor.z());
    dJointSetHinge2Axes(joint_.get(), axis_W.data(), axis2_W.data());
  } else if (type_ == JointType::kUniversal) {
    joint_.reset(dJointCreateUniversal(world, nullptr));
    dJointAttach(joint_.get(), parent_, child_);
    dJointSetUniversalAnchor(joint_.get(), anchor.x(), anchor.y(), anchor.z());
    dJointSetUniversalAxis1(joint_.get(), axis_W.x(), axis_W.y(), axis_W.z());
    dJointSetUniversalAxis2(joint_.get(), axis2_W.x(), axis2_W.y(), axis2_W.z());
  } else {
    joint_.reset(dJointCreateHinge(world, nullptr));
    dJointAttach(joint_.get(), child_, parent_);
    dJointSetHingeAnchor(joint_.get(), anchor.x(), anchor.y(), anchor.z());
    dJointSetHingeAxis(joint_.get(), axis_W.x(), axis_W.y(), axis_W.z());
  }
}

void ModelJoint::make_drives(dWorldID world, const Joint& joint, const Vector3d& axis_W,
                             const Vector3d& axis2_W) {
  if (type_ == JointType::kFixed) return;
  if (type_ == JointType::kPrismatic) {
    drive_ = JointDrive::linear(world, child_, parent_, joint_.get(), axis_W,
                                properties_of(joint.axis, joint));
  } else if (type_ == JointType::kBall) {
    ball_damping_ = joint.axis.damping;
    if (ball_damping_ < 1e-12) return;
    ball_damper_.reset(dJointCreateAMotor(world, nullptr));
    dJointAttach(ball_damper_.get(), child_, parent_);
    dJointSetAMotorMode(ball_damper_.get(), dAMotorUser);
    dJointSetAMotorNumAxes(ball_damper_.get(), 3);
    for (int i = 0; i < 3; ++i) {
      const Vector3d unit = Vector3d::Unit(i);
      dJointSetAMotorAxis(ball_damper_.get(), i, 0, unit.x(), unit.y(), unit.z());
      dJointSetAMotorParam(ball_damper_.get(), dParamFMax + dParamGroup * i, dInfinity);
      dJointSetAMotorParam(ball_damper_.get(), dParamCFM + dParamGroup * i, 1.0 / ball_damping_);
    }
  } else {
    JointProperties first = properties_of(joint.axis, joint);
    if (type_ == JointType::kContinuous) {
      first.lower = -dInfinity;
      first.upper = dInfinity;
    }
    drive_ = JointDrive::rotational(world, child_, parent_, 2, axis_W, first);
    if (has_two_axes(type_)) {
      drive2_ = JointDrive::rotational(world, child_, parent_, 1, axis2_W,
                                       properties_of(joint.axis2, joint));
    }
  }
}

Vector3d ModelJoint::axis_W() const { return body_pose(parent_).q * axis_P_; }

Vector3d ModelJoint::axis2_W() const { return body_pose(child_).q * axis2_C_; }

/// The direction along which a turn of one axis is measured and pushed, so that the other axis has
/// no part in it: of two axes that are not at right angles, the one that is at right angles to the
/// other, with 1 along its own.
Vector3d ModelJoint::direction(std::size_t axis) const {
  if (!inclined_) return axis == 0 ? axis_W() : axis2_W();
  const Vector3d own = axis == 0 ? axis_W() : axis2_W();
  const Vector3d other = axis == 0 ? axis2_W() : axis_W();
  const double cosine = own.dot(other);
  return (own - cosine * other) / (1.0 - cosine * cosine);
}

void ModelJoint::aim_drives() {
  for (std::size_t axis = 0; axis < axes(); ++axis) {
    const Vector3d along = direction(axis);
    drive(axis).aim(along, 1.0 / along.norm());
  }
}

Vector3d ModelJoint::relative_rate() const {
  return to_vector(dBodyGetAngularVel(child_)) - to_vector(dBodyGetAngularVel(parent_));
}

double ModelJoint::measured() const {
  const Pose X_WC = body_pose(child_), X_WP = body_pose(parent_);
  if (type_ == JointType::kBall || type_ == JointType::kFixed) return 0.0;
  if (type_ == JointType::kPrismatic) {
    return (X_WP.inverse() * (X_WC * anchor_C_) - anchor_P_).dot(axis_P_);
  }
  if (has_two_axes(type_)) {
    // The first axis alone moves the second.
    const Vector3d turned = X_WP.q.conjugate() * (X_WC.q * axis2_C_);
    const Vector3d start = axis2_P_ - axis2_P_.dot(axis_P_) * axis_P_;
    return std::atan2(axis_P_.cross(start).dot(turned), start.dot(turned));
  }
  // q_PC = turn * q_PC0, with the turn about the axis in the parent.
  return twist_angle(X_WP.q.conjugate() * X_WC.q * q_PC0_.conjugate(), axis_P_);
}

double ModelJoint::angle2() const {
  // What the child turns beyond the first axis: q_PC = turn1 * turn2 * q_PC0.
  const Quaterniond q_PC = body_pose(parent_).q.conjugate() * body_pose(child_).q;
  const Quaterniond turn1(Eigen::AngleAxisd(position_, axis_P_));
  return twist_angle(turn1.conjugate() * q_PC * q_PC0_.conjugate(), axis2_P_);
}

double ModelJoint::velocity() const {
  if (type_ == JointType::kBall || type_ == JointType::kFixed) return 0.0;
  if (type_ == JointType::kPrismatic) {
    const Vector3d anchor = body_pose(child_) * anchor_C_;
    dVector3 v_child, v_parent;
    dBodyGetPointVel(child_, anchor.x(), anchor.y(), anchor.z(), v_child);
    dBodyGetPointVel(parent_, anchor.x(), anchor.y(), anchor.z(), v_parent);
    return (to_vector(v_child) - to_vector(v_parent)).dot(axis_W());
  }
  return relative_rate().dot(direction(0));
}

double ModelJoint::clamp(double position) const { return drive_ ? drive_->clamp(position) : 0.0; }

Pose ModelJoint::motion_to(double position) const {
  const double change = clamp(position) - position_;
  const Vector3d axis = axis_W();
  if (type_ == JointType::kPrismatic) return {change * axis, Quaterniond::Identity()};
  const Quaterniond turn(Eigen::AngleAxisd(change, axis));
  const Vector3d anchor = body_pose(parent_) * anchor_P_;
  return {anchor - turn * anchor, turn};
}

void ModelJoint::shift_frames(const Vector3d& child_C, const Vector3d& parent_P) {
  anchor_C_ -= child_C;
  anchor_P_ -= parent_P;
  const Vector3d anchor = body_pose(child_) * anchor_C_;
  if (type_ == JointType::kPrismatic) {
    // The engine takes the place of the child when the axis is set for the slider's zero.
    const Pose X_WC = body_pose(child_);
    const Vector3d axis = axis_W();
    set_body_pose(child_, {X_WC.p - measured() * axis, X_WC.q});
    dJointSetSliderAxis(joint_.get(), axis.x(), axis.y(), axis.z());
    set_body_pose(child_, X_WC);
  } else if (type_ == JointType::kBall) {
    dJointSetBallAnchor(joint_.get(), anchor.x(), anchor.y(), anchor.z());
  } else if (type_ == JointType::kFixed) {
    dJointSetFixed(joint_.get());
  } else if (type_ == JointType::kRevolute2) {
    dJointSetHinge2Anchor(joint_.get(), anchor.x(), anchor.y(), anchor.z());
  } else if (type_ == JointType::kUniversal) {
    dJointSetUniversalAnchor(joint_.get(), anchor.x(), anchor.y(), anchor.z());
  } else {
    dJointSetHingeAnchor(joint_.get(), anchor.x(), anchor.y(), anchor.z());
  }
}

void ModelJoint::keep_wrench() {
  if (!feedback_.empty()) return;
  std::vector<dJointID> all{joint_.get()};
  if (ball_damper_) all.push_back(ball_damper_.get());
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
    const bool is_first = dJointGetBody(joint, 0) == child_;
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
  (type_ == JointType::kPrismatic ? applied_.force : applied_.torque) = along * direction(0);
  push(along);
  effort_ = 0.0;
}

void ModelJoint::push(double along) const {
  const Vector3d effort = along * direction(0);
  if (type_ == JointType::kPrismatic) {
    const Vector3d anchor = body_pose(child_) * anchor_C_;
    dBodyAddForceAtPos(child_, effort.x(), effort.y(), effort.z(), anchor.x(), anchor.y(),
                       anchor.z());
    dBodyAddForceAtPos(parent_, -effort.x(), -effort.y(), -effort.z(), anchor.x(), anchor.y(),
                       anchor.z());
    return;
  }
  dBodyAddTorque(child_, effort.x(), effort.y(), effort.z());
  dBodyAddTorque(parent_, -effort.x(), -effort.y(), -effort.z());
}

void ModelJoint::prepare(const StepSettings& step) {
  if (inclined_) aim_drives();
  if (drive_) drive_->prepare(position_, velocity(), step);
  if (drive2_) drive2_->prepare(position2_, relative_rate().dot(direction(1)), step);
  apply_effort();
  if (feedback_.empty()) return;
  const Pose X_WC = body_pose(child_);
  arm_W_ = X_WC.p - X_WC * anchor_C_;
}

void ModelJoint::take_position() {
  position_ = measured();
  if (type_ == JointType::kPrismatic) return;
  for (const double turned : {position_ + 2.0 * M_PI, position_ - 2.0 * M_PI}) {
    if (clamp(position_) != position_ && clamp(turned) == turned) position_ = turned;
  }
  if (drive2_) position2_ = angle2();
}

void ModelJoint::measure() {
  const double now = measured();
  position_ = type_ == JointType::kPrismatic ? now : unwrap(now, position_);
  if (drive2_) position2_ = unwrap(angle2(), position2_);
}

}  // namespace ardee::physics
