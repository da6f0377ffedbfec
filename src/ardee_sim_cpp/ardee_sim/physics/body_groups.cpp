// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/body_groups.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numeric>
#include <sstream>

#include "ardee_sim/core/error.h"

namespace ardee::physics {
namespace {

constexpr char kWorldName[] = "world";
// From a grain of dust to a mountain: within these the engine's arithmetic cannot overflow.
constexpr double kMinMass = 1e-9, kMaxMass = 1e12;       // kg
constexpr double kMinMoment = 1e-15, kMaxMoment = 1e18;  // kg m^2

/// The steps of union-find: each link points at a link of lower index in its group, the root at
/// itself. The last element stands for the world.
std::size_t find_root(std::vector<std::size_t>& parents, std::size_t element) {
  while (parents[element] != element) {
    parents[element] = parents[parents[element]];
    element = parents[element];
  }
  return element;
}

std::vector<std::size_t> unite_fixed(const Model& model) {
  const LinkIndex index = index_links(model);
  const auto index_of = [&](const std::string& link, const Joint& joint) {
    const auto found = index.find(link);
    if (found != index.end()) return found->second;
    throw Error(joint.source, "joint '" + joint.name + "' of model '" + model.name +
                                  "': found link '" + link + "', expected a link of the model");
  };
  std::vector<std::size_t> parents(model.links.size() + 1);
  std::iota(parents.begin(), parents.end(), std::size_t{0});
  for (const Joint& joint : model.joints) {
    const std::size_t child = index_of(joint.child, joint);
    const std::size_t parent =
        joint.parent == kWorldName ? model.links.size() : index_of(joint.parent, joint);
    if (joint.type != JointType::kFixed) continue;
    const std::size_t a = find_root(parents, child);
    const std::size_t b = find_root(parents, parent);
    parents[std::max(a, b)] = std::min(a, b);
  }
  for (std::size_t i = 0; i < parents.size(); ++i) parents[i] = find_root(parents, i);
  return parents;
}

bool names_world(const Model& model) {
  for (const Joint& joint : model.joints) {
    if (joint.parent == kWorldName) return true;
  }
  return false;
}

Eigen::Matrix3d point_inertia(double mass_kg, const Eigen::Vector3d& r) {
  return mass_kg * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
}

void check_link_inertial(const Link& link) {
  const Inertial& inertial = *link.inertial;
  if (!std::isfinite(inertial.mass_kg) || inertial.mass_kg < 0.0) {
    std::ostringstream what;
    what << "link '" << link.name << "': found mass " << inertial.mass_kg
         << " kg, expected a finite mass that is not negative";
    throw Error(link.source, what.str());
  }
  if (!inertial.inertia_kg_m2.allFinite() || !inertial.X_LI.is_finite()) {
    throw Error(link.source, "link '" + link.name + "': found an inertia that is not finite");
  }
}

void sum_mass(const Model& model, BodyGroup& group) {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  Eigen::Vector3d gravity_moment = Eigen::Vector3d::Zero();
  for (const std::size_t index : group.links) {
    const Link& link = model.links[index];
    if (!link.inertial) continue;
    check_link_inertial(link);
    const double mass_kg = link.inertial->mass_kg;
    const Eigen::Vector3d com_M = (link.X_ML * link.inertial->X_LI).p;
    group.mass_kg += mass_kg;
    moment += mass_kg * com_M;
    if (!link.gravity) continue;
    group.gravity_mass_kg += mass_kg;
    gravity_moment += mass_kg * com_M;
  }
  if (group.mass_kg > 0.0) group.com_M = moment / group.mass_kg;
  if (group.gravity_mass_kg > 0.0) group.gravity_com_M = gravity_moment / group.gravity_mass_kg;
}

void sum_inertia(const Model& model, BodyGroup& group) {
  for (const std::size_t index : group.links) {
    const Link& link = model.links[index];
    if (!link.inertial) continue;
    const Pose X_MI = link.X_ML * link.inertial->X_LI;
    const Eigen::Matrix3d R_MI = X_MI.q.toRotationMatrix();
    group.inertia_M += R_MI * link.inertial->inertia_kg_m2 * R_MI.transpose() +
                       point_inertia(link.inertial->mass_kg, X_MI.p - group.com_M);
  }
  const Eigen::Matrix3d symmetric = 0.5 * (group.inertia_M + group.inertia_M.transpose());
  group.inertia_M = symmetric;
}

void check_movable(const Model& model, const BodyGroup& group) {
  const Link& link = model.links[group.links.front()];
  std::ostringstream what;
  what << "link '" << link.name << "' of model '" << model.name << "': found ";
  if (!(group.mass_kg >= kMinMass && group.mass_kg <= kMaxMass)) {
    what << "a mass of " << group.mass_kg << " kg on a link that can move, expected one in ["
         << kMinMass << ", " << kMaxMass << "]";
    throw Error(link.source, what.str());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(group.inertia_M,
                                                              Eigen::EigenvaluesOnly);
  const Eigen::Vector3d moments = solver.eigenvalues();
  const double least = std::max(kMinMoment, 1e-9 * moments.maxCoeff());
  if (moments.minCoeff() >= least && moments.maxCoeff() <= kMaxMoment) return;
  what << "an inertia with principal moments " << moments.transpose()
       << " kg m^2, expected all of them positive, of one order and in [" << kMinMoment << ", "
       << kMaxMoment << "]";
  throw Error(link.source, what.str());
}

}  // namespace

LinkIndex index_links(const Model& model) {
  LinkIndex index;
  for (std::size_t i = 0; i < model.links.size(); ++i) index.emplace(model.links[i].name, i);
  return index;
}

BodyGroups group_links(const Model& model) {
  const std::vector<std::size_t> roots = unite_fixed(model);
  const std::size_t world_element = model.links.size();
  BodyGroups result;
  std::vector<std::size_t> group_of_root(roots.size(), BodyGroups::kNone);
  for (std::size_t i = 0; i < roots.size(); ++i) {
    if (i == world_element && !names_world(model)) continue;
    std::size_t& group = group_of_root[roots[i]];
    if (group == BodyGroups::kNone) {
      group = result.groups.size();
      result.groups.emplace_back();
    }
    if (i == world_element) {
      result.world = group;
      result.groups[group].kinematic = true;
      continue;
    }
    result.of_link.push_back(group);
    result.groups[group].links.push_back(i);
    if (model.links[i].kinematic || model.is_static) result.groups[group].kinematic = true;
  }
  for (BodyGroup& group : result.groups) {
    sum_mass(model, group);
    if (group.kinematic) continue;
    sum_inertia(model, group);
    check_movable(model, group);
  }
  return result;
}

}  // namespace ardee::physics
