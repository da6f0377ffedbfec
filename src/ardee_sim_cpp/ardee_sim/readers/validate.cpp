// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/validate.h"

#include <Eigen/Eigenvalues>
#include <set>
#include <sstream>

namespace ardee {
namespace {

std::string list_of_links(const Model& model) {
  constexpr std::size_t kMost = 12;
  std::string names;
  for (std::size_t i = 0; i < model.links.size() && i < kMost; ++i) {
    names += (i == 0 ? "'" : ", '") + model.links[i].name + "'";
  }
  return names + (model.links.size() > kMost ? ", ..." : "");
}

std::string comma_list(const Eigen::Vector3d& v) {
  std::ostringstream text;
  text << v[0] << ", " << v[1] << ", " << v[2];
  return text.str();
}

/// Says that a link has no mass or inertia of its own, which one fixed to another can do without:
/// a frame, a point mass.
void lacks_inertia(const Link& link, bool is_fixed, const std::string& what, Log& log) {
  if (!is_fixed) throw Error(link.source, what);
  log.warn(link.source.to_string() + ": " + what + "; it moves with the link that it is fixed to");
}

void check_inertial(const Link& link, bool is_fixed, Log& log) {
  const Inertial& inertial = *link.inertial;
  const std::string of = " of link '" + link.name + "'";
  if (!(inertial.mass_kg > 0.0)) {
    std::ostringstream what;
    what << "found mass " << inertial.mass_kg << " kg" << of << ", expected a positive one";
    lacks_inertia(link, is_fixed && inertial.mass_kg == 0.0, what.str(), log);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertial.inertia_kg_m2,
                                                              Eigen::EigenvaluesOnly);
  const Eigen::Vector3d& moments = solver.eigenvalues();  // ascending
  if (!(moments[0] > 0.0)) {
    std::ostringstream what;
    what << "found an inertia" << of << " with principal moments " << comma_list(moments)
         << " kg m^2, expected three positive ones";
    lacks_inertia(link, is_fixed && moments[0] == 0.0, what.str(), log);
    return;
  }
  constexpr double kSlack = 1.001;  // rounding of hand-written files
  if (kSlack * (moments[0] + moments[1]) < moments[2]) {
    std::ostringstream what;
    what << link.source.to_string() << ": found an inertia" << of << " with principal moments "
         << comma_list(moments)
         << " kg m^2, which no body has (the largest exceeds the others' sum)";
    log.warn(what.str());
  }
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
  return "found link '" + name + "', expected one of " + list_of_links(model);
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
    if (!link.inertial || model.is_static) continue;
    check_inertial(link, fixed.count(link.name) != 0, log);
  }
  for (const Joint& joint : model.joints) check_joint(joint, links, model);
}

}  // namespace ardee
