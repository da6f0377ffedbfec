// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "ardee_sim/core/error.h"
#include "ardee_sim/physics/dynamic_model.h"

namespace ardee::physics {
namespace {

using Eigen::Vector3d;

void require(bool valid, const Model& model, const std::string& what) {
  if (valid) return;
  throw Error("model '" + model.name + "': found " + what + " that is not finite or out of range");
}

bool is_valid(double value) { return std::abs(value) <= kMaxInput; }

bool is_valid(const Vector3d& value) {
  return is_valid(value.x()) && is_valid(value.y()) && is_valid(value.z());
}

void set_velocity(dBodyID body, const Vector3d& linear, const Vector3d& angular) {
  dBodySetLinearVel(body, linear.x(), linear.y(), linear.z());
  dBodySetAngularVel(body, angular.x(), angular.y(), angular.z());
}

}  // namespace

Pose DynamicModel::pose() const {
  return link_pose(canonical_) * model_->links[canonical_].X_ML.inverse();
}

void DynamicModel::set_pose(const Pose& X_WM) {
  require(X_WM.is_finite() && is_valid(X_WM.p), *model_, "a pose");
  const Pose motion = X_WM * pose().inverse();
  for (std::size_t i = 0; i < bodies_.size(); ++i) move_body(i, motion);
}

void DynamicModel::set_twist(const Twist& twist_W) {
  require(is_valid(twist_W.linear) && is_valid(twist_W.angular), *model_, "a velocity");
  const Vector3d origin = pose().p;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (i == groups_.world) continue;
    const Vector3d arm = body_pose(body(i)).p - origin;
    set_velocity(body(i), twist_W.linear + twist_W.angular.cross(arm), twist_W.angular);
  }
}

Pose DynamicModel::link_pose(std::size_t link) const {
  return body_pose(body(groups_.of_link.at(link))) * X_BL_[link];
}

Twist DynamicModel::link_twist(std::size_t link) const {
  dBodyID carrier = body(groups_.of_link.at(link));
  const Pose X_WB = body_pose(carrier);
  const Vector3d angular = to_vector(dBodyGetAngularVel(carrier));
  const Vector3d arm = X_WB.q * X_BL_[link].p;
  return {to_vector(dBodyGetLinearVel(carrier)) + angular.cross(arm), angular};
}

double DynamicModel::joint_position(std::size_t joint) const {
  return moving_joint(joint) ? moving_joint(joint)->position() : 0.0;
}

double DynamicModel::joint_velocity(std::size_t joint) const {
  return moving_joint(joint) ? moving_joint(joint)->velocity() : 0.0;
}

std::vector<std::size_t> DynamicModel::hanging_on(std::size_t joint) const {
  const Joint& cut = model_->joints[joint];
  std::vector<std::size_t> found{child_group(cut)};
  const auto has = [&found](std::size_t group) {
    return std::find(found.begin(), found.end(), group) != found.end();
  };
  for (std::size_t next = 0; next < found.size(); ++next) {
    for (std::size_t i = 0; i < model_->joints.size(); ++i) {
      if (i == joint || !moving_joint(i)) continue;
      const std::size_t child = child_group(model_->joints[i]);
      const std::size_t parent = parent_group(model_->joints[i]);
      if (child == found[next] && !has(parent)) found.push_back(parent);
      if (parent == found[next] && !has(child)) found.push_back(child);
    }
  }
  if (has(parent_group(cut))) {
    throw Error("joint '" + cut.name + "' of model '" + model_->name +
                "': found it in a closed chain, its position cannot be set alone");
  }
  return found;
}

void DynamicModel::set_joint_position(std::size_t joint, double position) {
  ModelJoint* moved = moving_joint(joint);
  require(is_valid(position), *model_, "a joint position");
  if (!moved || model_->joints[joint].type == JointType::kBall) return;
  const Pose motion = moved->motion_to(position);
  for (const std::size_t group : hanging_on(joint)) move_body(group, motion);
  moved->set_position(moved->clamp(position));
}

void DynamicModel::apply_wrench(std::size_t link, const Vector3d& force_W, const Vector3d& point_W,
                                const Vector3d& torque_W) {
  require(is_valid(force_W) && is_valid(point_W) && is_valid(torque_W), *model_, "a wrench");
  dBodyID pushed = body(groups_.of_link.at(link));
  dBodyAddForceAtPos(pushed, force_W.x(), force_W.y(), force_W.z(), point_W.x(), point_W.y(),
                     point_W.z());
  dBodyAddTorque(pushed, torque_W.x(), torque_W.y(), torque_W.z());
}

void DynamicModel::apply_joint_effort(std::size_t joint, double effort) {
  require(is_valid(effort), *model_, "a joint effort");
  if (ModelJoint* driven = moving_joint(joint)) driven->add_effort(effort);
}

}  // namespace ardee::physics
