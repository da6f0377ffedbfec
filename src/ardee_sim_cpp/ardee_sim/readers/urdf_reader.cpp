// SPDX-License-Identifier: MIT
#include <algorithm>
#include <unordered_map>

#include "ardee_sim/readers/gz_systems.h"
#include "ardee_sim/readers/realsense.h"
#include "ardee_sim/readers/schema.h"
#include "ardee_sim/readers/urdf.h"
#include "ardee_sim/readers/validate.h"

namespace ardee {
namespace {

void refuse_xacro(const Node& robot) {
  robot.each([](const Node& child) {
    if (child.name().substr(0, 6) == "xacro:") {
      throw child.error("found a xacro element, expected a URDF that xacro has expanded");
    }
  });
}

/// Fixes the joint of a link if neither the link nor the links fixed to it have mass, as it could
/// not move. Gazebo leaves such a link out with all links below it; here it keeps its place. A
/// robot without any mass is not changed: it is a drawing, or an error of the physics.
void hold_massless_links(const std::vector<Link>& links, const std::vector<std::size_t>& order,
                         std::vector<UrdfJoint>& joints, Log& log) {
  const auto has_mass = [](const Link& link) {
    return link.inertial && link.inertial->mass_kg > 0;
  };
  if (std::none_of(links.begin(), links.end(), has_mass)) return;
  std::unordered_map<std::string, UrdfJoint*> joint_above;
  for (UrdfJoint& each : joints) joint_above[each.joint.child] = &each;
  std::unordered_map<std::string, bool> has_inertial;  // of a link or the links fixed to it
  for (const Link& link : links) has_inertial[link.name] = has_mass(link);
  for (auto link = order.rbegin(); link != order.rend(); ++link) {  // children before parents
    const auto above = joint_above.find(links[*link].name);
    if (above == joint_above.end() || above->second->is_free) continue;
    const Joint& joint = above->second->joint;
    if (joint.type == JointType::kFixed && has_inertial[joint.child]) {
      has_inertial[joint.parent] = true;
    }
  }
  for (UrdfJoint& each : joints) {
    Joint& joint = each.joint;
    if (each.is_free || joint.type == JointType::kFixed || has_inertial[joint.child]) continue;
    log.warn(joint.source, "found no mass on a link that moves, expected one; it is held",
             ": link '" + joint.child + "' by joint '" + joint.name + "'");
    joint.type = JointType::kFixed;
  }
}

/// The root link represents the robot; but if it is called "world", it is the world, and the first
/// link below it represents the robot.
void take_out_world(const std::vector<std::size_t>& order, Model& made, Log& log) {
  const Link& root = made.links[order.front()];
  made.canonical_link = root.name;
  if (root.name != "world") return;
  if (!root.visuals.empty() || !root.collisions.empty()) {
    log.warn(root.source,
             "found visuals or collisions of the link 'world', expected none: it is "
             "the world itself; they are left out");
  }
  made.canonical_link = order.size() > 1 ? made.links[order[1]].name : "";
  made.links.erase(made.links.begin() + static_cast<std::ptrdiff_t>(order.front()));
}

/// Couples each joint that mimics another; a fixed or floating joint neither leads nor follows.
void couple_joints(const std::vector<UrdfJoint>& joints, Model& model, Log& log) {
  const auto moves = [](const UrdfJoint& each) {
    return !each.is_free && each.joint.type != JointType::kFixed;
  };
  for (const UrdfJoint& each : joints) {
    if (!each.mimic) continue;
    const auto leader = std::find_if(joints.begin(), joints.end(), [&](const UrdfJoint& other) {
      return other.joint.name == each.mimic->leader;
    });
    if (leader == joints.end() || &*leader == &each) {
      throw Error(each.mimic->source, "joint '" + each.joint.name + "': found <mimic> of joint '" +
                                          each.mimic->leader +
                                          "', expected another joint of the robot");
    }
    if (moves(each) && moves(*leader)) {
      model.couplings.push_back(*each.mimic);
    } else {
      log.warn(each.mimic->source, "found <mimic> of a joint that does not move, or in one");
    }
  }
}

}  // namespace

std::shared_ptr<const Model> read_urdf(const Node& robot, Assets& assets) {
  refuse_xacro(robot);
  urdf_schema().check(robot, assets.log());
  auto made = std::make_shared<Model>();
  made->name = robot.required_attribute("name");
  made->source = robot.source();
  UrdfMaterials materials(robot, assets);
  robot.each("link", [&](const Node& link) {
    made->links.push_back(read_urdf_link(link, materials, assets));
  });
  std::vector<UrdfJoint> joints;
  robot.each("joint",
             [&](const Node& joint) { joints.push_back(read_urdf_joint(joint, assets.log())); });
  const UrdfTree tree = make_urdf_tree(robot, made->links, joints);
  for (std::size_t i = 0; i < made->links.size(); ++i) made->links[i].X_ML = tree.X_ML[i];
  hold_massless_links(made->links, tree.order, joints, assets.log());
  couple_joints(joints, *made, assets.log());
  for (UrdfJoint& each : joints) {
    if (!each.is_free) made->joints.push_back(std::move(each.joint));
  }
  robot.each("transmission", [&](const Node& transmission) {
    auto read = read_transmission(transmission, assets.log());
    if (read) made->transmissions.push_back(std::move(*read));
  });
  take_out_world(tree.order, *made, assets.log());
  apply_gazebo_blocks(robot, *made, assets);
  adopt_realsense(*made, assets.log());
  adopt_gz_systems(*made, assets.log());
  validate_model(*made, assets.log());
  return made;
}

}  // namespace ardee
