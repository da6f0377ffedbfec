// SPDX-License-Identifier: MIT Properties of a model that can be changed while it moves.
#include <cmath>

#include "ardee_sim/core/error.h"
#include "ardee_sim/core/limits.h"
#include "ardee_sim/description/bounds.h"
#include "ardee_sim/physics/dynamic_model.h"

namespace ardee::physics {
namespace {

using Eigen::Vector3d;

/// Fault of an axis's numbers; empty if there is none.
std::string fault_of(const JointProperties& properties) {
  const JointSpring& spring = properties.spring;
  if (!(properties.lower <= properties.upper)) {
    return "found a lower limit above the upper, or one that is not a number";
  }
  if (!(properties.max_effort >= 0.0) || !(properties.max_velocity >= 0.0)) {
    return "found a limit of effort or velocity that is negative or not a number";
  }
  using bounds::kJointCoefficient, bounds::kJointSoftness;
  if (!kJointCoefficient.holds(spring.stiffness) || !kJointCoefficient.holds(spring.damping) ||
      !kJointCoefficient.holds(properties.friction) ||
      !bounds::kJointReference.holds(spring.reference)) {
    return "found a stiffness, damping, friction or reference that is negative, not finite or "
           "above 1e9";
  }
  if (!kJointSoftness.holds(properties.stop_erp) || !kJointSoftness.holds(properties.stop_cfm) ||
      !kJointSoftness.holds(properties.motor_cfm)) {
    return "found an ERP or CFM that is not finite or above 1e9";
  }
  return "";
}

bool same_inertia(const LinkProperties& a, const LinkProperties& b) {
  if (!a.inertial || !b.inertial) return !a.inertial && !b.inertial;
  return a.inertial->mass_kg == b.inertial->mass_kg &&
         a.inertial->inertia_kg_m2 == b.inertial->inertia_kg_m2 &&
         a.inertial->X_LI.p == b.inertial->X_LI.p &&
         a.inertial->X_LI.q.coeffs() == b.inertial->X_LI.q.coeffs();
}

}  // namespace

bool LinkProperties::operator==(const LinkProperties& other) const {
  return gravity == other.gravity && same_inertia(*this, other);
}

void DynamicModel::set_link_properties(std::size_t link, const LinkProperties& properties) {
  std::vector<LinkProperties> links = links_;
  links.at(link) = properties;
  const std::size_t index = groups_.of_link[link];
  BodyGroup group = groups_.groups[index];
  // A description's impossible inertia has been mended with a warning; a new one is refused.
  sum_masses(*model_, links, group,
             same_inertia(properties, links_[link]) ? OnImpossible::kMend : OnImpossible::kRefuse);
  wake();
  links_ = std::move(links);
  mass_kg_ += group.mass_kg - groups_.groups[index].mass_kg;
  const Vector3d shift = group.com_M - groups_.groups[index].com_M;
  groups_.groups[index] = group;
  set_mass(index);
  if (!shift.isZero(0.0)) shift_frame(index, shift);
}

void DynamicModel::shift_frame(std::size_t group, const Vector3d& shift_B) {
  dBodyID moved = body(group);
  Pose X_WB = body_pose(moved);
  const Vector3d arm = X_WB.q * shift_B;
  const Vector3d velocity =
      to_vector(dBodyGetLinearVel(moved)) + to_vector(dBodyGetAngularVel(moved)).cross(arm);
  X_WB.p += arm;
  set_body_pose(moved, X_WB);
  dBodySetLinearVel(moved, velocity.x(), velocity.y(), velocity.z());
  for (const std::size_t link : groups_.groups[group].links) X_BL_[link].p -= shift_B;
  for (const Shape& shape : shapes_) {
    if (shape.group != group) continue;
    dGeomID geom = shape.shape.geom.get();
    const Vector3d offset = to_vector(dGeomGetOffsetPosition(geom)) - shift_B;
    dGeomSetOffsetPosition(geom, offset.x(), offset.y(), offset.z());
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (!joints_[i]) continue;
    const Joint& joint = model_->joints[i];
    const Vector3d child = child_group(joint) == group ? shift_B : Vector3d(0, 0, 0);
    const Vector3d parent = parent_group(joint) == group ? shift_B : Vector3d(0, 0, 0);
    if (!child.isZero(0.0) || !parent.isZero(0.0)) joints_[i]->shift_frames(child, parent);
  }
}

JointDrive& DynamicModel::drive(std::size_t joint, std::size_t axis) const {
  if (axis < joint_axes(joint)) return joints_[joint]->drive(axis);
  throw Error("joint '" + model_->joints[joint].name + "' of model '" + model_->name +
              "': found axis " + std::to_string(axis) + ", expected one of its " +
              std::to_string(joint_axes(joint)) + " (counted from 0) that can be driven");
}

std::size_t DynamicModel::joint_axes(std::size_t joint) const {
  return moving_joint(joint) ? moving_joint(joint)->axes() : 0;
}

const JointProperties& DynamicModel::joint_properties(std::size_t joint, std::size_t axis) const {
  return drive(joint, axis).properties();
}

void DynamicModel::set_joint_properties(std::size_t joint, std::size_t axis,
                                        const JointProperties& properties) {
  const std::string fault = fault_of(properties);
  if (!fault.empty()) {
    throw Error("joint '" + model_->joints.at(joint).name + "' of model '" + model_->name +
                "': " + fault);
  }
  drive(joint, axis).set_properties(properties);
  wake();
}

void DynamicModel::set_joint_spring(std::size_t joint, const JointSpring& spring) {
  if (joint_axes(joint) == 0) return;
  JointProperties properties = joint_properties(joint, 0);
  properties.spring = spring;
  set_joint_properties(joint, 0, properties);
}

void DynamicModel::set_joint_limits(std::size_t joint, double lower, double upper) {
  if (joint_axes(joint) == 0) return;
  JointProperties properties = joint_properties(joint, 0);
  properties.lower = lower;
  properties.upper = upper;
  set_joint_properties(joint, 0, properties);
}

void DynamicModel::couple_joints(const Coupling& coupling) {
  const auto named = [&](const std::string& name) -> ModelJoint& {
    const auto found = index_of_joint(name);
    if (found && joint_axes(*found) > 0) return *joints_[*found];
    throw Error(coupling.source, "model '" + model_->name + "': found coupled joint '" + name +
                                     "', expected a joint of the model that has an axis");
  };
  ModelJoint& leader = named(coupling.leader);
  ModelJoint& follower = named(coupling.follower);
  if (&leader == &follower || !std::isfinite(coupling.multiplier) ||
      !std::isfinite(coupling.offset) || !(coupling.max_effort >= 0.0)) {
    throw Error(coupling.source, "model '" + model_->name + "': found joint '" + coupling.follower +
                                     "' coupled to itself or by a number that is not finite");
  }
  wake();
  couplings_.insert_or_assign(coupling.follower, JointCoupling(coupling, leader, follower));
  if (coupling.offset != 0.0)
    set_joint_position(*index_of_joint(coupling.leader), leader.position());
}

std::optional<std::size_t> DynamicModel::index_of_joint(const std::string& name) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (model_->joints[i].name == name) return i;
  }
  return std::nullopt;
}

const JointMotor& DynamicModel::joint_motor(std::size_t joint, std::size_t axis) const {
  return drive(joint, axis).motor();
}

void DynamicModel::set_joint_motor(std::size_t joint, std::size_t axis, const JointMotor& motor) {
  if (!(std::abs(motor.velocity) <= limits::kFastest) || !(motor.max_effort >= 0.0)) {
    throw Error("joint '" + model_->joints.at(joint).name + "' of model '" + model_->name +
                "': found a motor's velocity that is not finite or above 1e9, or an effort below "
                "zero");
  }
  drive(joint, axis).set_motor(motor);
  wake();
}

void DynamicModel::set_joint_motor(std::size_t joint, double velocity, double max_effort) {
  if (joint_axes(joint) > 0) set_joint_motor(joint, 0, {velocity, max_effort});
}

}  // namespace ardee::physics
