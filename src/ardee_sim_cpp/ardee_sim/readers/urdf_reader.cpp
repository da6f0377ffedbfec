// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/urdf_reader.h"

#include <urdf_model/model.h>

#include <algorithm>
#include <limits>
#include <map>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/readers/sdf_geometry.h"
#include "ardee_sim/readers/urdf_check.h"
#include "ardee_sim/readers/urdf_gazebo.h"
#include "ardee_sim/readers/urdf_library.h"
#include "ardee_sim/readers/validate.h"

namespace ardee {
namespace {

Pose pose_of(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  return {{pose.position.x, pose.position.y, pose.position.z},
          Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized()};
}

/// None, with an error, where a mesh's file may be left out.
std::optional<Geometry> geometry_of(const urdf::Geometry& geometry, const Source& source,
                                    Assets& assets) {
  if (const auto* box = dynamic_cast<const urdf::Box*>(&geometry)) {
    return Box{{box->dim.x, box->dim.y, box->dim.z}};
  }
  if (const auto* sphere = dynamic_cast<const urdf::Sphere*>(&geometry)) {
    return Sphere{sphere->radius};
  }
  if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(&geometry)) {
    return Cylinder{cylinder->radius, cylinder->length};
  }
  const auto& mesh = dynamic_cast<const urdf::Mesh&>(geometry);
  std::optional<Geometry> made;
  assets.has_files([&] {
    made = make_mesh(mesh.filename, "", false, {mesh.scale.x, mesh.scale.y, mesh.scale.z}, source,
                     assets);
  });
  return made;
}

Material material_of(const urdf::Material& material, const Source& source, Assets& assets) {
  Material made;
  made.name = material.name;
  made.diffuse = {material.color.r, material.color.g, material.color.b, material.color.a};
  made.diffuse = made.diffuse.cwiseMax(0.0f).cwiseMin(1.0f);
  if (!material.texture_filename.empty()) {
    made.texture_path = assets.texture(material.texture_filename, source);
    if (made.diffuse.head<3>().isZero()) made.diffuse.setOnes();  // a texture without a colour
  }
  made.ambient = made.diffuse;
  return made;
}

/// As libsdformat names them: base_collision, base_collision_1, ...
std::string body_name(const std::string& given, const std::string& link, const char* kind,
                      std::size_t index) {
  if (!given.empty()) return given;
  return link + "_" + kind + (index == 0 ? "" : "_" + std::to_string(index));
}

std::optional<Inertial> inertial_of(const urdf::Inertial* inertial) {
  if (!inertial) return std::nullopt;
  Inertial made;
  made.mass_kg = inertial->mass;
  made.X_LI = pose_of(inertial->origin);
  made.inertia_kg_m2 << inertial->ixx, inertial->ixy, inertial->ixz, inertial->ixy, inertial->iyy,
      inertial->iyz, inertial->ixz, inertial->iyz, inertial->izz;
  return made;
}

/// The places of a link's visuals or collisions in the file, for messages.
std::vector<Source> body_sources(const Node& link, const char* kind) {
  std::vector<Source> sources;
  link.each(kind, [&sources](const Node& body) {
    sources.push_back(body.required("geometry").source());
  });
  return sources;
}

Link read_link(const Node& node, const urdf::Link& link, Assets& assets) {
  Link made;
  made.name = link.name;
  made.source = node.source();
  made.inertial = inertial_of(link.inertial.get());
  const auto collision_sources = body_sources(node, "collision");
  for (std::size_t i = 0; i < link.collision_array.size(); ++i) {
    const urdf::Collision& collision = *link.collision_array[i];
    Collision body;
    body.name = body_name(collision.name, link.name, "collision", i);
    body.X_LC = pose_of(collision.origin);
    auto geometry = geometry_of(*collision.geometry, collision_sources.at(i), assets);
    if (!geometry) continue;
    body.geometry = std::move(*geometry);
    made.collisions.push_back(std::move(body));
  }
  const auto visual_sources = body_sources(node, "visual");
  for (std::size_t i = 0; i < link.visual_array.size(); ++i) {
    const urdf::Visual& visual = *link.visual_array[i];
    Visual body;
    body.name = body_name(visual.name, link.name, "visual", i);
    body.X_LV = pose_of(visual.origin);
    auto geometry = geometry_of(*visual.geometry, visual_sources.at(i), assets);
    if (!geometry) continue;
    body.geometry = std::move(*geometry);
    if (visual.material) {
      body.material = material_of(*visual.material, visual_sources.at(i), assets);
    }
    made.visuals.push_back(std::move(body));
  }
  return made;
}

/// Exporters write effort="0" velocity="0", which URDF requires, where nothing is known; Gazebo's
/// drives turn such wheels all the same.
double unlimited_unless_positive(double limit) {
  return limit > 0.0 ? limit : std::numeric_limits<double>::infinity();
}

JointType type_of(const urdf::Joint& joint) {
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
      return JointType::kRevolute;
    case urdf::Joint::CONTINUOUS:
      return JointType::kContinuous;
    case urdf::Joint::PRISMATIC:
      return JointType::kPrismatic;
    default:
      return JointType::kFixed;
  }
}

/// Nothing holds the child of such a joint, as in Gazebo.
bool is_free(const urdf::Joint& joint) {
  return joint.type == urdf::Joint::FLOATING || joint.type == urdf::Joint::PLANAR;
}

Joint read_joint(const Node& node, const urdf::Joint& joint) {
  Joint made;
  made.name = joint.name;
  made.source = node.source();
  made.type = type_of(joint);
  made.parent = joint.parent_link_name;
  made.child = joint.child_link_name;
  if (made.type == JointType::kFixed) return made;
  made.axis.axis = Eigen::Vector3d(joint.axis.x, joint.axis.y, joint.axis.z).normalized();
  if (joint.limits) {
    if (made.type != JointType::kContinuous) {
      made.axis.lower = joint.limits->lower;
      made.axis.upper = joint.limits->upper;
    }
    made.axis.effort = unlimited_unless_positive(joint.limits->effort);
    made.axis.velocity = unlimited_unless_positive(joint.limits->velocity);
  }
  if (joint.dynamics) {
    made.axis.damping = joint.dynamics->damping;
    made.axis.friction = joint.dynamics->friction;
  }
  if (const auto dynamics = node.child("dynamics")) {
    // Not of URDF itself, but written by some for Gazebo's sake.
    const Source at = dynamics->source();
    made.axis.spring_stiffness = parse_number(dynamics->attribute("spring_stiffness", "0"), at);
    made.axis.spring_reference = parse_number(dynamics->attribute("spring_reference", "0"), at);
  }
  return made;
}

/// Whether neither a link nor what is fixed to it further out has an <inertial>.
bool lacks_inertial(const Model& model, const std::string& name) {
  const Link* link = model.find_link(name);
  if (link && link->inertial) return false;
  return std::all_of(model.joints.begin(), model.joints.end(), [&](const Joint& joint) {
    return joint.parent != name || joint.type != JointType::kFixed ||
           lacks_inertial(model, joint.child);
  });
}

/// Nothing can move what has no mass. Gazebo leaves such a link out with all that hangs on it; here
/// it keeps its place. A robot without any mass is as it is: a drawing, or an error of the physics.
void hold_massless_links(Model& model, Log& log) {
  const auto has_mass = [](const Link& link) {
    return link.inertial && link.inertial->mass_kg > 0;
  };
  if (std::none_of(model.links.begin(), model.links.end(), has_mass)) return;
  for (Joint& joint : model.joints) {
    if (joint.type == JointType::kFixed || !lacks_inertial(model, joint.child)) continue;
    log.warn(joint.source.to_string() + ": found no <inertial> on link '" + joint.child +
             "', expected one on a link that moves; joint '" + joint.name + "' is held");
    joint.type = JointType::kFixed;
  }
}

/// Poses of all links in the root link's frame, with each joint at zero.
std::map<std::string, Pose> link_poses(const urdf::ModelInterface& robot) {
  std::map<std::string, Pose> poses;
  std::vector<std::pair<const urdf::Link*, Pose>> open{{robot.getRoot().get(), Pose{}}};
  while (!open.empty()) {
    const auto [link, X_ML] = open.back();
    open.pop_back();
    poses[link->name] = X_ML;
    for (const auto& joint : link->child_joints) {
      const auto child = robot.getLink(joint->child_link_name);
      open.emplace_back(child.get(), X_ML * pose_of(joint->parent_to_joint_origin_transform));
    }
  }
  return poses;
}

}  // namespace

std::shared_ptr<const Model> read_urdf(const std::string& text, const Node& root, Assets& assets) {
  check_urdf(root, assets.log());
  const auto robot = parse_with_urdfdom(text, root.source(), assets.log());
  const auto poses = link_poses(*robot);
  const std::string& root_name = robot->getRoot()->name;
  auto made = std::make_shared<Model>();
  made->name = robot->getName();
  made->source = root.source();
  root.each("link", [&](const Node& node) {
    const auto link = robot->getLink(node.required_attribute("name"));
    if (link->name == "world" && link->name == root_name) return;
    made->links.push_back(read_link(node, *link, assets));
    made->links.back().X_ML = poses.at(link->name);
  });
  root.each("joint", [&](const Node& node) {
    const auto joint = robot->getJoint(node.required_attribute("name"));
    if (!is_free(*joint)) made->joints.push_back(read_joint(node, *joint));
  });
  if (!made->links.empty()) {
    made->canonical_link = made->find_link(root_name) ? root_name : made->links.front().name;
  }
  hold_massless_links(*made, assets.log());
  apply_gazebo_blocks(root, *made, assets);
  validate_model(*made, assets.log());
  return made;
}

}  // namespace ardee
