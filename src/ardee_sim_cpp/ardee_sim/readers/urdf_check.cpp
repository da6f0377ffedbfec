// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/urdf_check.h"

#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/readers/schema.h"

namespace ardee {
namespace {

struct NumberRule {
  const char* element;
  const char* attribute;
  std::size_t count;
  bool required = false;
  bool bounded = true;
};

constexpr NumberRule kNumbers[] = {{"origin", "xyz", 3},
                                   {"origin", "rpy", 3},
                                   {"mass", "value", 1, true},
                                   {"inertia", "ixx", 1, true},
                                   {"inertia", "ixy", 1, true},
                                   {"inertia", "ixz", 1, true},
                                   {"inertia", "iyy", 1, true},
                                   {"inertia", "iyz", 1, true},
                                   {"inertia", "izz", 1, true},
                                   {"box", "size", 3, true},
                                   {"sphere", "radius", 1, true},
                                   {"cylinder", "radius", 1, true},
                                   {"cylinder", "length", 1, true},
                                   {"mesh", "scale", 3},
                                   {"axis", "xyz", 3},
                                   {"limit", "lower", 1, false, false},
                                   {"limit", "upper", 1, false, false},
                                   {"limit", "effort", 1, true, false},
                                   {"limit", "velocity", 1, true, false},
                                   {"dynamics", "damping", 1},
                                   {"dynamics", "friction", 1},
                                   {"dynamics", "spring_stiffness", 1},
                                   {"dynamics", "spring_reference", 1},
                                   {"color", "rgba", 4, true},
                                   {"mimic", "multiplier", 1},
                                   {"mimic", "offset", 1}};

std::vector<double> check_number(const Node& node, const NumberRule& rule) {
  const std::string text =
      rule.required ? node.required_attribute(rule.attribute) : node.attribute(rule.attribute);
  std::istringstream words(text);
  std::vector<double> values;
  const Source place = node.source();
  for (std::string word; words >> word;) {
    values.push_back(parse_number(word, place));
    if (rule.bounded && std::abs(values.back()) > kAbsurd) {
      throw node.error("found " + std::string(rule.attribute) + "='" + text +
                       "', expected numbers in [-1e+09, 1e+09]");
    }
  }
  if (values.size() != rule.count && node.has_attribute(rule.attribute)) {
    throw node.error("found " + std::string(rule.attribute) + "='" + text + "', expected " +
                     std::to_string(rule.count) + " numbers");
  }
  return values;
}

void check_numbers(const Node& node) {
  for (const NumberRule& rule : kNumbers) {
    if (node.name() != rule.element) continue;
    const std::vector<double> values = check_number(node, rule);
    const bool is_size =
        node.name() == "box" || node.name() == "sphere" || node.name() == "cylinder";
    for (const double value : values) {
      if (is_size && !(value > 0.0)) {
        throw node.error("found " + std::string(rule.attribute) + "='" +
                         node.attribute(rule.attribute) + "', expected positive numbers");
      }
    }
  }
  node.each([](const Node& child) { check_numbers(child); });
}

void check_geometries(const Node& link) {
  for (const char* kind : {"visual", "collision"}) {
    link.each(kind, [](const Node& body) {
      const Node geometry = body.required("geometry");
      bool known = false;
      geometry.each([&known](const Node& shape) {
        const std::string_view name = shape.name();
        known = name == "box" || name == "sphere" || name == "cylinder" || name == "mesh";
        if (!known) throw shape.error("found this shape, expected box, sphere, cylinder or mesh");
        if (name == "mesh") shape.required_attribute("filename");
      });
      if (!known) throw geometry.error("found no shape, expected box, sphere, cylinder or mesh");
    });
  }
}

void check_joint(const Node& joint, Log& log) {
  const std::string type = joint.required_attribute("type");
  static const std::set<std::string> kTypes{"fixed",     "revolute", "continuous",
                                            "prismatic", "floating", "planar"};
  if (kTypes.count(type) == 0) {
    throw joint.error("found joint type '" + type +
                      "', expected fixed, revolute, continuous, prismatic, floating or planar");
  }
  if (type == "planar") {
    log.warn(joint.source().to_string() +
             ": planar joints are not supported, the child moves freely");
  }
  const auto limit = joint.child("limit");
  if (!limit && (type == "revolute" || type == "prismatic")) {
    throw joint.error("found no <limit> in a " + type + " joint, expected one");
  }
  if (limit && type != "continuous" && limit->has_attribute("lower") &&
      limit->has_attribute("upper") &&
      parse_number(limit->attribute("lower"), limit->source()) >
          parse_number(limit->attribute("upper"), limit->source())) {
    throw limit->error("found a lower limit above the upper, expected it below");
  }
  if (const auto axis = joint.child("axis"); axis && type != "fixed") {
    const std::vector<double> xyz = check_number(*axis, {"axis", "xyz", 3, true});
    if (!(Eigen::Vector3d(xyz[0], xyz[1], xyz[2]).norm() > 1e-9)) {
      throw axis->error("found '" + axis->attribute("xyz") +
                        "', expected an axis longer than zero");
    }
  }
}

/// One root, each other link the child of one joint, all of them reached from the root.
class TreeCheck {
 public:
  void add_link(const Node& link) {
    const std::string name = link.required_attribute("name");
    if (!parents_.emplace(name, "").second) {
      throw link.error("found a second link '" + name + "', expected unique names");
    }
  }

  void add_joint(const Node& joint) {
    const std::string name = joint.required_attribute("name");
    if (!joints_.insert(name).second) {
      throw joint.error("found a second joint '" + name + "', expected unique names");
    }
    const std::string parent = end_of(joint, "parent");
    const std::string child = end_of(joint, "child");
    if (parent == child) {
      throw joint.error("joint '" + name + "': found '" + parent +
                        "' as parent and child, expected two links");
    }
    if (!parents_[child].empty()) {
      throw joint.error("joint '" + name + "': found link '" + child +
                        "' as the child of a second joint, expected one");
    }
    parents_[child] = parent;
  }

  void finish(const Node& robot) const {
    std::string roots;
    int count = 0;
    for (const auto& [link, parent] : parents_) {
      if (!parent.empty()) continue;
      roots += (count++ == 0 ? "'" : ", '") + link + "'";
    }
    if (parents_.empty()) throw robot.error("found no <link>, expected one or more");
    if (count == 0) throw robot.error("found joints in a loop and no root link, expected a tree");
    if (count > 1) {
      throw robot.error("found " + std::to_string(count) + " root links " + roots +
                        ", expected one that all others hang on");
    }
    for (const auto& entry : parents_) check_reached(entry.first, robot);
  }

 private:
  std::string end_of(const Node& joint, const char* end) const {
    const Node node = joint.required(end);
    std::string link = node.required_attribute("link");
    if (parents_.count(link) == 0) {
      throw node.error("found link '" + link + "' in joint '" + joint.attribute("name") +
                       "', expected one that exists");
    }
    return link;
  }

  void check_reached(const std::string& link, const Node& robot) const {
    std::string at = link;
    for (std::size_t steps = 0; !parents_.at(at).empty(); at = parents_.at(at)) {
      if (++steps > parents_.size()) {
        throw robot.error("found joints in a loop through link '" + link + "', expected a tree");
      }
    }
  }

  std::map<std::string, std::string> parents_;  // of each link; empty: a root
  std::set<std::string> joints_;
};

}  // namespace

void check_urdf(const Node& root, Log& log) {
  root.each([](const Node& child) {
    if (child.name().substr(0, 6) == "xacro:") {
      throw child.error("found a xacro element, expected a URDF that xacro has expanded");
    }
  });
  urdf_schema().check(root, log);
  root.required_attribute("name");
  TreeCheck tree;
  root.each("link", [&](const Node& link) {
    tree.add_link(link);
    check_numbers(link);
    check_geometries(link);
  });
  root.each("joint", [&](const Node& joint) {
    check_numbers(joint);
    check_joint(joint, log);
    tree.add_joint(joint);
  });
  root.each("material", [](const Node& material) { check_numbers(material); });
  tree.finish(root);
}

}  // namespace ardee
