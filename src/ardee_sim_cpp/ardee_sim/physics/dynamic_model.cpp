// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/dynamic_model.h"

#include <algorithm>
#include <set>

#include "ardee_sim/core/error.h"
#include "ardee_sim/core/limits.h"

namespace ardee::physics {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr std::size_t kRowsPerJoint = 8;  // five of the joint, stop, motor or friction, spring

/// The rotation by a constant rate over a step.
Quaterniond turn_of(const Vector3d& rate, double step_s) {
  const double speed = rate.norm();
  if (speed == 0.0) return Quaterniond::Identity();
  return Quaterniond(Eigen::AngleAxisd(speed * step_s, rate / speed));
}

bool pulls_all_or_nothing(const BodyGroup& group) {
  return group.gravity_mass_kg == group.mass_kg || group.gravity_mass_kg == 0.0;
}

}  // namespace

DynamicModel::DynamicModel(dWorldID world, std::shared_ptr<const Model> model, const Pose& X_WM,
                           ShapeFactory& factory, const std::string& name)
    : model_(std::move(model)), name_(name) {
  if (model_->links.empty()) {
    throw Error(model_->source,
                "model '" + model_->name + "': found no link, expected one or more");
  }
  if (!limits::is_valid(X_WM)) {
    throw Error(model_->source, "model '" + model_->name +
                                    "': found a pose that is not finite or "
                                    "beyond the world's range");
  }
  for (const Joint& joint : model_->joints) check_joint(*model_, joint);
  links_ = described_links(*model_);
  groups_ = group_links(*model_, links_);
  link_index_ = index_links(*model_);
  for (std::size_t i = 0; i < model_->links.size(); ++i) {
    if (model_->links[i].name == model_->canonical_link) canonical_ = i;
  }
  may_rest_ = model_->allow_auto_disable && model_->plugins.empty() &&
              std::all_of(model_->links.begin(), model_->links.end(),
                          [](const Link& link) { return link.sensors.empty(); });
  make_bodies(world, X_WM);
  make_shapes(factory);
  make_joints(world, X_WM);
  for (const Coupling& coupling : model_->couplings) couple_joints(coupling);
  find_self_pairs();
  order_carriers();
}

void DynamicModel::make_bodies(dWorldID world, const Pose& X_WM) {
  for (const BodyGroup& group : groups_.groups) {
    bodies_.emplace_back(dBodyCreate(world));
    dBodyID body = bodies_.back().get();
    mass_kg_ += group.mass_kg;
    if (group.kinematic) dBodySetKinematic(body);
    set_mass(bodies_.size() - 1);
    // Exact rotation over a step: a wheel turns by rate times step, not by twice the arc tangent of
    // half that.
    dBodySetFiniteRotationMode(body, 1);
    dBodySetAutoDisableFlag(body, 0);
    dBodyDisable(body);  // the solver enables what it steps
    set_body_pose(body, X_WM * Pose{group.com_M, Eigen::Quaterniond::Identity()});
  }
  for (std::size_t i = 0; i < model_->links.size(); ++i) {
    Pose X_BL = model_->links[i].X_ML;
    X_BL.p -= groups_.groups[groups_.of_link[i]].com_M;
    X_BL_.push_back(X_BL);
  }
}

void DynamicModel::set_mass(std::size_t index) {
  const BodyGroup& group = groups_.groups[index];
  dBodySetGravityMode(body(index), group.gravity_mass_kg == group.mass_kg ? 1 : 0);
  if (group.kinematic) return;
  if (group.linear_decay > 0.0) dBodySetLinearDamping(body(index), group.linear_decay);
  if (group.angular_decay > 0.0) dBodySetAngularDamping(body(index), group.angular_decay);
  const Eigen::Matrix3d& i = group.inertia_M;
  dMass mass;
  dMassSetParameters(&mass, group.mass_kg, 0, 0, 0, i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2),
                     i(1, 2));
  dBodySetMass(body(index), &mass);
}

void DynamicModel::make_shapes(ShapeFactory& factory) {
  for (std::size_t i = 0; i < model_->links.size(); ++i) {
    const Link& link = model_->links[i];
    for (const Collision& collision : link.collisions) {
      check_collision(*model_, link, collision);
      if (std::holds_alternative<Plane>(collision.geometry) ||
          std::holds_alternative<Heightmap>(collision.geometry)) {
        throw Error(link.source, "model '" + model_->name + "', link '" + link.name +
                                     "': found a plane or heightmap on a model that can move, "
                                     "expected it on a static one");
      }
      const std::size_t group = groups_.of_link[i];
      shapes_.push_back({factory.make(collision, Pose{}, 1.0), group, i});
      shapes_.back().shape.scoped_name = [this, &link, &collision] {
        return name_ + "::" + link.name + "::" + collision.name;
      };
      dGeomID geom = shapes_.back().shape.geom.get();
      const Pose X_BC = X_BL_[i] * collision.X_LC;
      const dQuaternion q = {X_BC.q.w(), X_BC.q.x(), X_BC.q.y(), X_BC.q.z()};
      dGeomSetBody(geom, body(group));
      dGeomSetOffsetPosition(geom, X_BC.p.x(), X_BC.p.y(), X_BC.p.z());
      dGeomSetOffsetQuaternion(geom, q);
    }
  }
}

std::size_t DynamicModel::child_group(const Joint& joint) const {
  return groups_.of_link[link_index_.at(joint.child)];
}

std::size_t DynamicModel::parent_group(const Joint& joint) const {
  if (joint.parent == "world") return groups_.world;
  return groups_.of_link[link_index_.at(joint.parent)];
}

void DynamicModel::make_joints(dWorldID world, const Pose& X_WM) {
  for (const Joint& joint : model_->joints) {
    joints_.emplace_back();
    if (is_lumped(*model_, joint)) continue;
    const std::size_t child = child_group(joint), parent = parent_group(joint);
    if (child == parent) {
      throw Error(joint.source, "joint '" + joint.name + "' of model '" + model_->name +
                                    "': found its two links fixed to each other");
    }
    const Link& link = model_->links[link_index_.at(joint.child)];
    joints_.back() = std::make_unique<ModelJoint>(world, joint, body(child), body(parent),
                                                  X_WM * link.X_ML * joint.X_CJ);
    rows_ += kRowsPerJoint;
  }
}

void DynamicModel::find_self_pairs() {
  constexpr std::size_t kMostPairs = 1'000'000;
  std::set<ShapePair> joined;
  for (const Joint& joint : model_->joints) {
    joined.insert(std::minmax({child_group(joint), parent_group(joint)}));
  }
  const auto collides = [&](const Shape& shape) {
    return model_->self_collide || model_->links[shape.link].self_collide;
  };
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    if (!collides(shapes_[i])) continue;
    for (std::size_t j = i + 1; j < shapes_.size(); ++j) {
      const std::size_t a = shapes_[i].group, b = shapes_[j].group;
      if (a == b || !collides(shapes_[j]) || (is_kinematic(a) && is_kinematic(b))) continue;
      if (joined.count(std::minmax({a, b})) == 0) self_pairs_.emplace_back(i, j);
    }
    if (self_pairs_.size() > kMostPairs) {
      throw Error(model_->source, "model '" + model_->name + "': found more than " +
                                      std::to_string(kMostPairs) +
                                      " pairs of shapes that may touch each other, expected fewer");
    }
  }
}

void DynamicModel::move_body(std::size_t group, const Pose& motion) {
  set_body_pose(body(group), motion * body_pose(body(group)));
}

void DynamicModel::prepare_step(const StepSettings& step, const Vector3d& gravity_m_per_s2) {
  for (const auto& joint : joints_) {
    if (joint) joint->prepare(step);
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyGroup& group = groups_.groups[i];
    if (group.kinematic || pulls_all_or_nothing(group)) continue;
    const Vector3d force = group.gravity_mass_kg * gravity_m_per_s2;
    const Vector3d at = body_pose(body(i)) * Vector3d(group.gravity_com_M - group.com_M);
    dBodyAddForceAtPos(body(i), force.x(), force.y(), force.z(), at.x(), at.y(), at.z());
  }
}

void DynamicModel::order_carriers() {
  std::vector<std::size_t> open;
  std::vector<bool> is_carried(bodies_.size(), false);
  std::vector<std::vector<std::size_t>> carries(bodies_.size());
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (!joints_[i]) continue;
    const std::size_t child = child_group(model_->joints[i]);
    if (is_carried[child]) continue;  // carried by two: the first counts
    is_carried[child] = true;
    carries[parent_group(model_->joints[i])].push_back(child);
  }
  for (std::size_t group = 0; group < bodies_.size(); ++group) {
    if (!is_carried[group]) open.push_back(group);
  }
  for (std::size_t next = 0; next < open.size(); ++next) {
    for (const std::size_t child : carries[open[next]]) {
      carried_.push_back({child, open[next]});
      open.push_back(child);
    }
  }
}

void DynamicModel::turn_with_carriers(double step_s) {
  turns_.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    turns_[i] = turn_of(to_vector(dBodyGetAngularVel(body(i))), step_s);
  }
  for (const Carried& each : carried_) {
    const Vector3d rate = to_vector(dBodyGetAngularVel(body(each.group)));
    const Vector3d relative = rate - to_vector(dBodyGetAngularVel(body(each.carrier)));
    const Quaterniond before = turns_[each.group].conjugate();
    turns_[each.group] = turns_[each.carrier] * turn_of(relative, step_s);
    const Quaterniond now = to_quaternion(dBodyGetQuaternion(body(each.group)));
    const Quaterniond turned = turns_[each.group] * before * now;
    if (!turned.coeffs().allFinite()) continue;  // the check of the state reports it
    const dQuaternion q = {turned.w(), turned.x(), turned.y(), turned.z()};
    dBodySetQuaternion(body(each.group), q);
  }
}

void DynamicModel::finish_step(double step_s) {
  turn_with_carriers(step_s);
  for (const auto& joint : joints_) {
    if (joint) joint->measure();
  }
  if (may_rest_) watch_rest(step_s);
}

std::string DynamicModel::state_fault() const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Pose X_WB = body_pose(body(i));
    const Twist twist_W{to_vector(dBodyGetLinearVel(body(i))),
                        to_vector(dBodyGetAngularVel(body(i)))};
    if (limits::is_valid(X_WB) && limits::is_valid(twist_W)) continue;
    const bool finite =
        X_WB.is_finite() && twist_W.linear.allFinite() && twist_W.angular.allFinite();
    const std::string link =
        groups_.groups[i].links.empty() ? "world" : model_->links[groups_.groups[i].links[0]].name;
    return "model '" + model_->name + "', link '" + link + "': found a position or velocity " +
           (finite ? "beyond the world's range" : "that is not finite");
  }
  return "";
}

}  // namespace ardee::physics
