// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/validate.h"

#include <Eigen/Eigenvalues>
#include <set>
#include <sstream>

#include "ardee_sim/core/nearest_names.h"

namespace ardee {
namespace {

std::string comma_list(const Eigen::Vector3d& v) {
  std::ostringstream text;
  text << v[0] << ", " << v[1] << ", " << v[2];
  return text.str();
}

/// Checks the mass of a link. A link that is fixed to another one needs none: a frame.
void check_mass(const Link& link, bool is_fixed, Log& log) {
  const double mass_kg = link.inertial->mass_kg;
  if (mass_kg > 0.0) return;
  std::ostringstream what;
  what << "found mass " << mass_kg << " kg of link '" << link.name << "', expected a positive one";
  if (!is_fixed || mass_kg != 0.0) throw Error(link.source, what.str());
  log.warn(link.source, what.str() + "; it moves with the link that it is fixed to");
}

/// Checks the inertia of a link. An impossible one is accepted with a warning, as in Gazebo: the
/// physics sums the inertias of links that are fixed to each other, and uses the nearest possible
/// one if the sum is impossible too.
void check_inertia(const Link& link, bool is_fixed, Log& log) {
  const Eigen::Matrix3d& inertia = link.inertial->inertia_kg_m2;
  const std::string of = " of link '" + link.name + "'";
  if (!inertia.allFinite()) {
    throw Error(link.source, "found an inertia" + of + " that is not finite, expected one that is");
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia, Eigen::EigenvaluesOnly);
  const Eigen::Vector3d& moments = solver.eigenvalues();  // ascending
  constexpr double kSlack = 1.001;                        // rounding of hand-written files
  const bool is_positive = moments[0] > 0.0;
  if (is_positive && kSlack * (moments[0] + moments[1]) >= moments[2]) return;
  std::ostringstream what;
  what << "found an inertia" << of << " with principal moments " << comma_list(moments)
       << " kg m^2, which no body has";
  if (is_positive) {
    what << " (the largest exceeds the others' sum)";
  } else if (is_fixed) {
    what << ": it counts as a part of the body that the link is fixed to";
  } else {
    what << ": the nearest possible one is taken";
  }
  log.warn(link.source, what.str());
}

template <typename Item>
void check_names(const std::vector<Item>& items, const char* kind) {
  std::set<std::string> names;
  for (const Item& item : items) {
    if (item.name.empty()) {
      throw Error(item.source, "found a " + std::string(kind) + " without name, expected a name");
    }
    if (!names.insert(item.name).second) {
      throw Error(item.source, "found a second " + std::string(kind) + " '" + item.name +
                                   "', expected unique names");
    }
  }
}

void check_joint(const Joint& joint, const std::set<std::string>& links, const Model& model) {
  for (const std::string& name : {joint.parent, joint.child}) {
    if (name != "world" && links.count(name) == 0) {
      throw Error(joint.source, "joint '" + joint.name + "': " + unknown_link(name, model));
    }
  }
  if (joint.parent == joint.child) {
    throw Error(joint.source, "joint '" + joint.name + "': found '" + joint.parent +
                                  "' as parent and child, expected two links");
  }
}

}  // namespace

std::string unknown_link(const std::string& name, const Model& model) {
  std::vector<std::string> known;
  for (const Link& link : model.links) known.push_back(link.name);
  return "found link '" + name + "', expected one of " + nearest_names(name, known);
}

void validate_model(const Model& model, Log& log) {
  check_names(model.links, "link");
  check_names(model.joints, "joint");
  std::set<std::string> fixed;
  for (const Joint& joint : model.joints) {
    if (joint.type == JointType::kFixed) fixed.insert({joint.parent, joint.child});
  }
  std::set<std::string> links;
  for (const Link& link : model.links) {
    links.insert(link.name);
    // Static and kinematic links may have any inertia.
    if (!link.inertial || model.is_static || link.kinematic) continue;
    check_mass(link, fixed.count(link.name) != 0, log);
    check_inertia(link, fixed.count(link.name) != 0, log);
  }
  for (const Joint& joint : model.joints) check_joint(joint, links, model);
}

}  // namespace ardee
