// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "ardee_sim/core/error.h"
#include "ardee_sim/core/limits.h"
#include "ardee_sim/physics/body_states.h"
#include "ardee_sim/physics/dynamic_model.h"

namespace ardee::physics {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

void require(bool valid, const Model& model, const std::string& what) {
  if (valid) return;
  throw Error("model '" + model.name + "': found " + what + " that is not finite or out of range");
}

bool is_valid(double value) { return std::abs(value) <= limits::kStrongest; }

bool is_valid(const Vector3d& value) { return limits::is_within(value, limits::kStrongest); }

void set_velocity(dBodyID body, const Twist& twist_W) {
  const Vector3d &v = twist_W.linear, &w = twist_W.angular;
  dBodySetLinearVel(body, v.x(), v.y(), v.z());
  dBodySetAngularVel(body, w.x(), w.y(), w.z());
}

}  // namespace

Pose DynamicModel::pose() const {
  return link_pose(canonical_) * model_->links[canonical_].X_ML.inverse();
}

void DynamicModel::check_motion(std::size_t group, const Pose& motion) const {
  require(limits::is_valid(motion * body_pose(body(group))), *model_, "a pose");
}

void DynamicModel::set_twist(const Twist& twist_W) {
  check_twist(twist_W, Quaterniond::Identity());
  wake();
  set_velocities(twist_W);
}

void DynamicModel::set_velocities(const Twist& twist_W) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (i == groups_.world) continue;
    set_velocity(body(i), rigid_twist(i, twist_W, Quaterniond::Identity()));
  }
}

void DynamicModel::set_link_states(const LinkStates& states) {
  wake();
  // The first link of a body counts.
  for (std::size_t i = model_->links.size(); i-- > 0;) {
    const auto found = states.find(model_->links[i].name);
    if (found == states.end()) continue;
    const auto& [X_WL, twist_W] = found->second;
    require(limits::is_valid(X_WL), *model_, "a link's pose");
    require(limits::is_valid(twist_W), *model_, "a link's velocity");
    const std::size_t group = groups_.of_link[i];
    const Pose X_WB = X_WL * X_BL_[i].inverse();
    set_body_pose(body(group), X_WB);
    if (group == groups_.world) continue;
    const Vector3d arm = X_WB.p - X_WL.p;
    set_velocity(body(group), {twist_W.linear + twist_W.angular.cross(arm), twist_W.angular});
  }
  for (const auto& joint : joints_) {
    if (joint) joint->take_position();
  }
}

Twist DynamicModel::rigid_twist(std::size_t group, const Twist& twist_W,
                                const Quaterniond& turn) const {
  const Vector3d arm = turn * Vector3d(body_pose(body(group)).p - pose().p);
  return {twist_W.linear + twist_W.angular.cross(arm), twist_W.angular};
}

void DynamicModel::check_twist(const Twist& twist_W, const Quaterniond& turn) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    require(limits::is_valid(rigid_twist(i, twist_W, turn)), *model_, "a velocity");
  }
}

void DynamicModel::set_state(const Pose& X_WM, const Twist& twist_W) {
  const Pose motion = X_WM * pose().inverse();
  for (std::size_t i = 0; i < bodies_.size(); ++i) check_motion(i, motion);
  check_twist(twist_W, motion.q);
  wake();
  for (std::size_t i = 0; i < bodies_.size(); ++i) move_body(i, motion);
  set_velocities(twist_W);
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
    const std::string found_it = moving_joint(joint) ? "in a closed chain" : "fixed";
    throw Error("joint '" + cut.name + "' of model '" + model_->name + "': found it " + found_it +
                ", expected one whose position can be set alone");
  }
  return found;
}

void DynamicModel::set_joint_position(std::size_t joint, double position) {
  require(is_valid(position), *model_, "a joint position");
  std::vector<std::size_t> moved{joint};
  for (std::size_t i = 0; i < moved.size(); ++i) {
    hanging_on(moved[i]);  // throws before anything has moved
    for (const auto& [name, coupling] : couplings_) {
      const std::size_t follower = *index_of_joint(name);
      const bool is_moved = std::find(moved.begin(), moved.end(), follower) != moved.end();
      if (!is_moved && coupling.leader() == joints_[moved[i]].get()) moved.push_back(follower);
    }
  }
  for (const std::size_t each : moved) {
    // A follower stands where its leader puts it, as in Gazebo.
    const auto own = couplings_.find(model_->joints[each].name);
    place_joint(each, own != couplings_.end() ? own->second.wanted() : position);
  }
}

void DynamicModel::place_joint(std::size_t joint, double position) {
  ModelJoint* moved = moving_joint(joint);
  if (!moved || !moved->has_position()) return;
  const Pose motion = moved->motion_to(position);
  const std::vector<std::size_t> hanging = hanging_on(joint);
  for (const std::size_t group : hanging) check_motion(group, motion);
  wake();
  for (const std::size_t group : hanging) move_body(group, motion);
  moved->set_position(moved->clamp(position));
}

void DynamicModel::apply_wrench(std::size_t link, const Vector3d& force_W, const Vector3d& point_W,
                                const Vector3d& torque_W) {
  require(is_valid(force_W) && is_valid(point_W) && is_valid(torque_W), *model_, "a wrench");
  wake();
  dBodyID pushed = body(groups_.of_link.at(link));
  dBodyAddForceAtPos(pushed, force_W.x(), force_W.y(), force_W.z(), point_W.x(), point_W.y(),
                     point_W.z());
  dBodyAddTorque(pushed, torque_W.x(), torque_W.y(), torque_W.z());
}

void DynamicModel::apply_joint_effort(std::size_t joint, double effort) {
  require(is_valid(effort), *model_, "a joint effort");
  wake();
  if (ModelJoint* driven = moving_joint(joint)) driven->add_effort(effort);
}

void DynamicModel::want_joint_wrench(std::size_t joint) {
  if (moving_joint(joint)) {
    moving_joint(joint)->keep_wrench();
    return;
  }
  throw Error(model_->joints[joint].source,
              "joint '" + model_->joints[joint].name + "' of model '" + model_->name +
                  "': found it fixed, expected one that moves, or one that is not lumped, with "
                  "<provide_feedback> and mass on both sides");
}

ForceTorque DynamicModel::joint_wrench(std::size_t joint) const {
  return moving_joint(joint) ? moving_joint(joint)->wrench() : ForceTorque{};
}

void DynamicModel::serialize(StateArchive& state) {
  for (std::size_t link = 0; link < links_.size(); ++link) {
    LinkProperties properties = links_[link];
    state(properties);
    if (!(properties == links_[link])) set_link_properties(link, properties);
  }
  for (const BodyHandle& each : bodies_) {
    BodyState body_state(each.get());
    state(body_state);
    if (state.is_restoring()) body_state.restore(each.get());
  }
  for (const auto& joint : joints_) {
    if (joint) state(*joint);
  }
  for (auto& [follower, coupling] : couplings_) state(coupling.impulse);
  state(turns_, still_s_, still_poses_, rest_);
}

}  // namespace ardee::physics
