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
// Bounds from a grain of dust to a mountain, within which the engine's arithmetic cannot overflow.
constexpr double kMinMass = 1e-9, kMaxMass = 1e12;       // kg
constexpr double kMinMoment = 1e-15, kMaxMoment = 1e18;  // kg m^2
constexpr double kLeastShare = 1e-9;  // least moment, as a share of the largest one

/// The steps of union-find: each link points at a link of lower index in its group, the root at
/// itself. The last element represents the world.
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
    if (!is_lumped(model, joint)) continue;
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

void check_inertial(const Link& link, const Inertial& inertial, bool moves) {
  if (!std::isfinite(inertial.mass_kg) || inertial.mass_kg < 0.0) {
    std::ostringstream what;
    what << "link '" << link.name << "': found mass " << inertial.mass_kg
         << " kg, expected a finite mass that is not negative";
    throw Error(link.source, what.str());
  }
  if (moves && !inertial.inertia_kg_m2.allFinite()) {
    throw Error(link.source, "link '" + link.name + "': found an inertia that is not finite");
  }
  if (!inertial.X_LI.is_finite()) {
    throw Error(link.source, "link '" + link.name + "': found a centre of mass that is not finite");
  }
}

void sum_mass(const Model& model, const std::vector<LinkProperties>& links, BodyGroup& group) {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  Eigen::Vector3d gravity_moment = Eigen::Vector3d::Zero();
  group.mass_kg = group.gravity_mass_kg = 0.0;
  group.linear_decay = group.angular_decay = 0.0;
  for (const std::size_t index : group.links) {
    const std::optional<Inertial>& inertial = links[index].inertial;
    if (!inertial) continue;
    check_inertial(model.links[index], *inertial, !group.kinematic);
    const double mass_kg = inertial->mass_kg;
    const Eigen::Vector3d com_M = (model.links[index].X_ML * inertial->X_LI).p;
    group.mass_kg += mass_kg;
    moment += mass_kg * com_M;
    group.linear_decay += mass_kg * model.links[index].linear_decay;
    group.angular_decay += mass_kg * model.links[index].angular_decay;
    if (!links[index].gravity) continue;
    group.gravity_mass_kg += mass_kg;
    gravity_moment += mass_kg * com_M;
  }
  if (group.mass_kg > 0.0) {
    group.com_M = moment / group.mass_kg;
    group.linear_decay /= group.mass_kg;
    group.angular_decay /= group.mass_kg;
  }
  if (group.gravity_mass_kg > 0.0) group.gravity_com_M = gravity_moment / group.gravity_mass_kg;
}

void sum_inertia(const Model& model, const std::vector<LinkProperties>& links, BodyGroup& group) {
  group.inertia_M.setZero();
  for (const std::size_t index : group.links) {
    const std::optional<Inertial>& inertial = links[index].inertial;
    if (!inertial) continue;
    const Pose X_MI = model.links[index].X_ML * inertial->X_LI;
    const Eigen::Matrix3d R_MI = X_MI.q.toRotationMatrix();
    group.inertia_M += R_MI * inertial->inertia_kg_m2 * R_MI.transpose() +
                       point_inertia(inertial->mass_kg, X_MI.p - group.com_M);
  }
  const Eigen::Matrix3d symmetric = 0.5 * (group.inertia_M + group.inertia_M.transpose());
  group.inertia_M = symmetric;
}

void check_mass(const Model& model, const BodyGroup& group) {
  if (group.mass_kg >= kMinMass && group.mass_kg <= kMaxMass) return;
  const Link& link = model.links[group.links.front()];
  std::ostringstream what;
  what << "link '" << link.name << "' of model '" << model.name << "': found a mass of "
       << group.mass_kg << " kg on a link that can move, expected one in [" << kMinMass << ", "
       << kMaxMass << "]";
  throw Error(link.source, what.str());
}

/// Whether the engine can use an inertia: positive moments of similar magnitude.
bool is_usable(const Eigen::Matrix3d& inertia_kg_m2) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia_kg_m2,
                                                              Eigen::EigenvaluesOnly);
  const Eigen::Vector3d moments = solver.eigenvalues();
  const double least = std::max(kMinMoment, kLeastShare * moments.maxCoeff());
  return moments.minCoeff() >= least && moments.maxCoeff() <= kMaxMoment;
}

/// The nearest inertia that a body of this mass can have. A principal moment is the sum of the
/// second moments of mass along the two other axes; none of these can be less than that of a ball
/// of water.
Eigen::Matrix3d nearest_inertia(double mass_kg, const Eigen::Matrix3d& inertia_kg_m2) {
  constexpr double kWater_kg_per_m3 = 1000.0;
  const double radius_m = std::cbrt(mass_kg / (4.0 / 3.0 * M_PI * kWater_kg_per_m3));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia_kg_m2);
  const Eigen::Vector3d moments = solver.eigenvalues();
  Eigen::Vector3d second = 0.5 * moments.sum() - moments.array();
  const double ball = 0.2 * mass_kg * radius_m * radius_m;
  second = second.cwiseMax(std::max({ball, kMinMoment, kLeastShare * second.maxCoeff()}));
  const Eigen::Vector3d possible = second.sum() - second.array();
  return solver.eigenvectors() * possible.asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

bool is_lumped(const Model& model, const Joint& joint) {
  if (joint.type != JointType::kFixed) return false;
  const auto has_mass = [&model](const std::string& name) {
    const Link* link = model.find_link(name);
    return name == kWorldName || (link && link->inertial && link->inertial->mass_kg >= kMinMass);
  };
  return !joint.is_measured || !has_mass(joint.child) || !has_mass(joint.parent);
}

LinkIndex index_links(const Model& model) {
  LinkIndex index;
  for (std::size_t i = 0; i < model.links.size(); ++i) index.emplace(model.links[i].name, i);
  return index;
}

std::vector<LinkProperties> described_links(const Model& model) {
  std::vector<LinkProperties> links;
  for (const Link& link : model.links) links.push_back({link.inertial, link.gravity});
  return links;
}

void sum_masses(const Model& model, const std::vector<LinkProperties>& links, BodyGroup& group,
                OnImpossible what_then) {
  sum_mass(model, links, group);
  if (group.kinematic) return;
  check_mass(model, group);
  sum_inertia(model, links, group);
  if (is_usable(group.inertia_M)) return;
  const Eigen::Matrix3d summed = group.inertia_M;
  group.inertia_M = nearest_inertia(group.mass_kg, summed);
  if (what_then == OnImpossible::kMend && is_usable(group.inertia_M)) return;
  const Link& link = model.links[group.links.front()];
  std::ostringstream what;
  what << "link '" << link.name << "' of model '" << model.name
       << "': found an inertia with principal moments "
       << summed.selfadjointView<Eigen::Lower>().eigenvalues().transpose()
       << " kg m^2, expected three positive ones of one order, none above " << kMaxMoment;
  throw Error(link.source, what.str());
}

BodyGroups group_links(const Model& model, const std::vector<LinkProperties>& links) {
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
  for (BodyGroup& group : result.groups) sum_masses(model, links, group, OnImpossible::kMend);
  return result;
}

}  // namespace ardee::physics
