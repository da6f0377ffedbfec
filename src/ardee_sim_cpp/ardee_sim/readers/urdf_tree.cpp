// SPDX-License-Identifier: MIT
#include <limits>
#include <unordered_map>
#include <unordered_set>

#include "ardee_sim/readers/urdf.h"

namespace ardee {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// The joints of a tree by the links at their ends.
struct Branches {
  std::vector<std::size_t> joint_above;                // of each link; kNone: a root
  std::vector<std::vector<std::size_t>> joints_below;  // of each link
  std::vector<std::size_t> child;                      // of each joint
};

std::unordered_map<std::string, std::size_t> index_links(const std::vector<Link>& links) {
  std::unordered_map<std::string, std::size_t> index;
  for (const Link& link : links) {
    if (index.emplace(link.name, index.size()).second) continue;
    throw Error(link.source, "found a second link '" + link.name + "', expected unique names");
  }
  return index;
}

Branches connect(const std::vector<Link>& links, const std::vector<UrdfJoint>& joints) {
  const auto index = index_links(links);
  Branches made{std::vector<std::size_t>(links.size(), kNone),
                std::vector<std::vector<std::size_t>>(links.size()),
                {}};
  std::unordered_set<std::string> names;
  for (const UrdfJoint& each : joints) {
    const Joint& joint = each.joint;
    const auto refuse = [&joint](const std::string& what) {
      throw Error(joint.source, "joint '" + joint.name + "': found " + what);
    };
    if (!names.insert(joint.name).second) refuse("it a second time, expected unique names");
    for (const std::string& end : {joint.parent, joint.child}) {
      if (index.count(end) == 0) refuse("link '" + end + "', expected one that exists");
    }
    if (joint.parent == joint.child) {
      refuse("'" + joint.parent + "' as parent and child, expected two links");
    }
    const std::size_t child = index.at(joint.child);
    if (made.joint_above[child] != kNone) {
      refuse("link '" + joint.child + "' as the child of a second joint, expected one");
    }
    made.joint_above[child] = made.child.size();
    made.joints_below[index.at(joint.parent)].push_back(made.child.size());
    made.child.push_back(child);
  }
  return made;
}

std::size_t find_root(const Node& robot, const std::vector<Link>& links,
                      const std::vector<std::size_t>& joint_above) {
  constexpr std::size_t kMostNamed = 12;
  std::string names;
  std::size_t count = 0;
  std::size_t root = 0;
  for (std::size_t link = 0; link < links.size(); ++link) {
    if (joint_above[link] != kNone) continue;
    root = link;
    if (++count <= kMostNamed) names += (count == 1 ? "'" : ", '") + links[link].name + "'";
  }
  if (links.empty()) throw robot.error("found no <link>, expected one or more");
  if (count == 0) throw robot.error("found joints in a loop and no root link, expected a tree");
  if (count > 1) {
    throw robot.error("found " + std::to_string(count) + " root links " + names +
                      (count > kMostNamed ? ", ..." : "") +
                      ", expected one that all others hang on");
  }
  return root;
}

}  // namespace

UrdfTree make_urdf_tree(const Node& robot, const std::vector<Link>& links,
                        const std::vector<UrdfJoint>& joints) {
  const Branches branches = connect(links, joints);
  UrdfTree tree;
  tree.X_ML.resize(links.size());
  tree.order.push_back(find_root(robot, links, branches.joint_above));
  std::vector<bool> is_reached(links.size(), false);
  is_reached[tree.order.front()] = true;
  for (std::size_t done = 0; done < tree.order.size(); ++done) {
    const std::size_t parent = tree.order[done];
    for (const std::size_t joint : branches.joints_below[parent]) {
      const std::size_t child = branches.child[joint];
      tree.X_ML[child] = tree.X_ML[parent] * joints[joint].X_PC;
      is_reached[child] = true;
      tree.order.push_back(child);
    }
  }
  for (std::size_t link = 0; link < links.size(); ++link) {
    if (is_reached[link]) continue;
    throw robot.error("found joints in a loop through link '" + links[link].name +
                      "', expected a tree");
  }
  return tree;
}

}  // namespace ardee
