// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/urdf_gazebo.h"

#include <algorithm>
#include <functional>
#include <map>

#include "ardee_sim/readers/schema.h"
#include "ardee_sim/readers/sdf_joint.h"
#include "ardee_sim/readers/sdf_link.h"
#include "ardee_sim/readers/sdf_material.h"

namespace ardee {
namespace {

constexpr double kMaxStiffness = 1e20;

void each_surface(Link& link, const std::function<void(Surface&)>& change) {
  for (Collision& collision : link.collisions) change(collision.surface);
}

/// A property of all collisions of a link, by the names that it goes by.
using SurfaceRule = std::function<void(const Node&, Surface&)>;
const std::map<std::string, SurfaceRule, std::less<>>& surface_rules() {
  static const std::map<std::string, SurfaceRule, std::less<>> rules = [] {
    std::map<std::string, SurfaceRule, std::less<>> made;
    made["mu1"] = [](const Node& n, Surface& s) { s.mu = n.to_number(0.0, kMaxStiffness); };
    made["mu2"] = [](const Node& n, Surface& s) { s.mu2 = n.to_number(0.0, kMaxStiffness); };
    made["fdir1"] = [](const Node& n, Surface& s) { s.fdir1 = n.to_vector3(); };
    made["frictionCone"] = [](const Node& n, Surface& s) { s.friction_cone = n.to_boolean(); };
    made["slip1"] = [](const Node& n, Surface& s) { s.slip1 = n.to_number(0.0); };
    made["slip2"] = [](const Node& n, Surface& s) { s.slip2 = n.to_number(0.0); };
    made["kp"] = [](const Node& n, Surface& s) { s.kp_n_per_m = n.to_number(0.0, kMaxStiffness); };
    made["kd"] = [](const Node& n, Surface& s) {
      s.kd_n_s_per_m = n.to_number(0.0, kMaxStiffness);
    };
    made["minDepth"] = [](const Node& n, Surface& s) { s.min_depth_m = n.to_number(); };
    made["maxVel"] = [](const Node& n, Surface& s) {
      s.max_correcting_velocity_m_per_s = n.to_number(-1.0);
    };
    made["maxContacts"] = [](const Node& n, Surface& s) {
      s.max_contacts = n.to_integer(0, 100000);
    };
    made["mu"] = made["mu1"];
    made["min_depth"] = made["minDepth"];
    made["max_vel"] = made["maxVel"];
    made["max_contacts"] = made["maxContacts"];
    return made;
  }();
  return rules;
}

void set_material(const Node& material, Link& link, Assets& assets) {
  const bool detailed = material.child("script") || material.child("ambient") ||
                        material.child("diffuse") || material.child("specular") ||
                        material.child("emissive");
  const Material made = detailed ? read_sdf_material(material, assets)
                                 : assets.material(material.required_text(), {}, material.source());
  for (Visual& visual : link.visuals) visual.material = made;
}

/// A <visual> block speaks for all visuals of the link.
void apply_visual(const Node& node, Link& link, Assets& assets) {
  if (const auto material = node.child("material")) set_material(*material, link, assets);
  for (Visual& visual : link.visuals) {
    visual.transparency = node.number("transparency", visual.transparency, 0.0, 1.0);
    visual.cast_shadows = node.boolean("cast_shadows", visual.cast_shadows);
  }
}

/// A <collision> block speaks for all collisions of the link.
void apply_collision(const Node& node, Link& link) {
  for (Collision& collision : link.collisions) {
    collision.surface = read_sdf_surface(node, collision.surface);
    collision.laser_retro = node.number("laser_retro", collision.laser_retro);
  }
}

void apply_to_link(const Node& node, Link& link, Assets& assets) {
  const std::string_view name = node.name();
  const auto rule = surface_rules().find(name);
  if (rule != surface_rules().end()) {
    each_surface(link, [&](Surface& surface) { rule->second(node, surface); });
  } else if (name == "sensor") {
    link.sensors.push_back(read_sensor(node, node.pose()));
  } else if (name == "material") {
    set_material(node, link, assets);
  } else if (name == "visual") {
    apply_visual(node, link, assets);
  } else if (name == "collision") {
    apply_collision(node, link);
  } else if (name == "selfCollide" || name == "self_collide") {
    link.self_collide = node.to_boolean();
  } else if (name == "gravity") {
    link.gravity = node.to_boolean();
  } else if (name == "turnGravityOff") {
    link.gravity = !node.to_boolean();
  } else if (name == "kinematic") {
    link.kinematic = node.to_boolean();
  } else if (name == "dampingFactor") {
    link.linear_decay = link.angular_decay = node.to_number(0.0, 1.0);
  } else if (name == "velocity_decay") {
    link.linear_decay = node.number("linear", link.linear_decay, 0.0, 1.0);
    link.angular_decay = node.number("angular", link.angular_decay, 0.0, 1.0);
  } else if (name == "laserRetro" || name == "laser_retro") {
    for (Collision& collision : link.collisions) collision.laser_retro = node.to_number();
    for (Visual& visual : link.visuals) visual.laser_retro = node.to_number();
  }
}

void apply_to_joint(const Node& node, Joint& joint) {
  const std::string_view name = node.name();
  if (name == "stopCfm" || name == "stop_cfm") {
    joint.stop_cfm = node.to_number(0.0);
  } else if (name == "stopErp" || name == "stop_erp") {
    joint.stop_erp = node.to_number(0.0);
  } else if (name == "springStiffness" || name == "spring_stiffness") {
    joint.axis.spring_stiffness = node.to_number(0.0);
  } else if (name == "springReference" || name == "spring_reference") {
    joint.axis.spring_reference = node.to_number();
  }
}

void apply_to_model(const Node& node, Model& model) {
  const std::string_view name = node.name();
  if (name == "plugin") {
    model.plugins.push_back(read_plugin(node));
  } else if (name == "joint") {
    // An SDF joint, by which robots close kinematic loops that URDF's tree cannot have.
    constexpr double kSdfVersion = 1.6;
    SdfFrames frames("__model__");
    for (const Link& link : model.links) frames.add(link.name, link.X_ML);
    model.joints.push_back(read_sdf_joint(node, kSdfVersion, frames, model));
  } else if (name == "static") {
    model.is_static = node.to_boolean();
  } else if (name == "selfCollide" || name == "self_collide") {
    model.self_collide = node.to_boolean();
    for (Link& link : model.links) link.self_collide = link.self_collide || model.self_collide;
  }
}

template <typename Item>
Item* find_named(std::vector<Item>& items, const std::string& name) {
  const auto found = std::find_if(items.begin(), items.end(),
                                  [&name](const Item& item) { return item.name == name; });
  return found == items.end() ? nullptr : &*found;
}

void apply_block(const Node& block, Model& model, Assets& assets) {
  const std::string reference = block.attribute("reference");
  Link* link = find_named(model.links, reference);
  Joint* joint = link ? nullptr : find_named(model.joints, reference);
  if (!reference.empty() && !link && !joint) {
    assets.log().warn(block.source().to_string() + ": found reference '" + reference +
                      "', expected a link or joint of the robot; the block is left out");
    return;
  }
  gazebo_schema().check(block, link ? "link" : joint ? "joint" : "robot", assets.log());
  block.each([&](const Node& node) {
    if (link) {
      apply_to_link(node, *link, assets);
    } else if (joint) {
      apply_to_joint(node, *joint);
    } else {
      apply_to_model(node, model);
    }
  });
}

}  // namespace

void apply_gazebo_blocks(const Node& root, Model& model, Assets& assets) {
  root.each("gazebo", [&](const Node& block) { apply_block(block, model, assets); });
}

}  // namespace ardee
