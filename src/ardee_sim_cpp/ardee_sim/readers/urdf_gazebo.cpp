// SPDX-License-Identifier: MIT
#include <functional>
#include <map>
#include <unordered_map>

#include "ardee_sim/description/bounds.h"
#include "ardee_sim/readers/schema.h"
#include "ardee_sim/readers/sdf_parts.h"
#include "ardee_sim/readers/urdf.h"

namespace ardee {
namespace {

double read(const Node& node, const bounds::Range& range) {
  return node.to_number(range.low, range.high);
}

void each_surface(Link& link, const std::function<void(Surface&)>& change) {
  for (Collision& collision : link.collisions) change(collision.surface);
}

/// A property of all collisions of a link, by its names.
using SurfaceRule = std::function<void(const Node&, Surface&)>;
const std::map<std::string, SurfaceRule, std::less<>>& surface_rules() {
  static const std::map<std::string, SurfaceRule, std::less<>> rules = [] {
    std::map<std::string, SurfaceRule, std::less<>> made;
    made["mu1"] = [](const Node& n, Surface& s) { s.mu = read_friction(n, s.mu); };
    made["mu2"] = [](const Node& n, Surface& s) { s.mu2 = read_friction(n, s.mu2); };
    made["fdir1"] = [](const Node& n, Surface& s) { s.fdir1 = n.to_vector3(); };
    made["frictionCone"] = [](const Node& n, Surface& s) { s.friction_cone = n.to_boolean(); };
    made["slip1"] = [](const Node& n, Surface& s) { s.slip1 = read(n, bounds::kSlip); };
    made["slip2"] = [](const Node& n, Surface& s) { s.slip2 = read(n, bounds::kSlip); };
    made["kp"] = [](const Node& n, Surface& s) { s.kp_n_per_m = read(n, bounds::kStiffness); };
    made["kd"] = [](const Node& n, Surface& s) { s.kd_n_s_per_m = read(n, bounds::kDamping); };
    made["minDepth"] = [](const Node& n, Surface& s) {
      s.min_depth_m = read(n, bounds::kMinDepth);
    };
    made["maxVel"] = [](const Node& n, Surface& s) {
      s.max_correcting_velocity_m_per_s = read(n, bounds::kMaxVelocity);
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

/// An empty element counts as absent.
bool is_empty(const Node& node) {
  bool has_children = false;
  node.each([&has_children](const Node&) { has_children = true; });
  return !has_children && node.text().empty();
}

void set_material(const Node& material, Link& link, Assets& assets) {
  const bool detailed = material.child("script") || material.child("ambient") ||
                        material.child("diffuse") || material.child("specular") ||
                        material.child("emissive");
  if (!detailed && material.text().empty()) return;
  const Material made = detailed ? read_sdf_material(material, assets)
                                 : assets.material(material.text(), {}, material.source());
  for (Visual& visual : link.visuals) visual.material = made;
}

/// Applies a <visual> block to all visuals of the link.
void apply_visual(const Node& node, Link& link, Assets& assets) {
  if (const auto material = node.child("material")) set_material(*material, link, assets);
  for (Visual& visual : link.visuals) {
    visual.transparency = node.number("transparency", visual.transparency, 0.0, 1.0);
    visual.cast_shadows = node.boolean("cast_shadows", visual.cast_shadows);
  }
}

/// Applies a <collision> block to all collisions of the link.
void apply_collision(const Node& node, Link& link) {
  for (Collision& collision : link.collisions) {
    collision.surface = read_sdf_surface(node, collision.surface);
    collision.laser_retro = node.number("laser_retro", collision.laser_retro);
  }
}

void apply_to_link(const Node& node, Link& link, Assets& assets) {
  const std::string_view name = node.name();
  const auto rule = surface_rules().find(name);
  if (name == "sensor") {
    link.sensors.push_back(read_sensor(node, node.pose(), assets.log()));
  } else if (is_empty(node)) {
    return;
  } else if (rule != surface_rules().end()) {
    Surface unused;
    rule->second(node, unused);  // checks the value
    each_surface(link, [&](Surface& surface) { rule->second(node, surface); });
    if (link.collisions.empty()) {
      assets.log().warn(node.source(), "has no effect: the link has no collision");
    }
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
    link.linear_decay = link.angular_decay = read(node, bounds::kDecay);
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
  if (is_empty(node)) return;
  if (name == "stopCfm" || name == "stop_cfm") {
    joint.stop_cfm = read(node, bounds::kJointSoftness);
  } else if (name == "stopErp" || name == "stop_erp") {
    joint.stop_erp = read(node, bounds::kJointSoftness);
  } else if (name == "springStiffness" || name == "spring_stiffness") {
    joint.axis.spring_stiffness = read(node, bounds::kJointCoefficient);
  } else if (name == "springReference" || name == "spring_reference") {
    joint.axis.spring_reference = read(node, bounds::kJointReference);
  } else if (name == "provideFeedback" || name == "provide_feedback") {
    joint.is_measured = node.to_boolean();
  } else if (name == "physics") {
    constexpr bounds::Range kSoftness = bounds::kJointSoftness;
    joint.stop_cfm = node.number("ode/limit/cfm", joint.stop_cfm, kSoftness.low, kSoftness.high);
    joint.stop_erp = node.number("ode/limit/erp", joint.stop_erp, kSoftness.low, kSoftness.high);
  }
}

/// Applies blocks to a model, whose links and joints it finds by name.
class GazeboBlocks {
 public:
  GazeboBlocks(Model& model, Assets& assets)
      : model_(model), assets_(assets), frames_("__model__") {
    for (std::size_t i = 0; i < model.links.size(); ++i) {
      links_.emplace(model.links[i].name, i);
      frames_.add(model.links[i].name, model.links[i].X_ML);
    }
    for (std::size_t i = 0; i < model.joints.size(); ++i) joints_.emplace(model.joints[i].name, i);
  }

  void apply(const Node& block) {
    const std::string reference = block.attribute("reference");
    const auto link = links_.find(reference);
    const auto joint = joints_.find(reference);
    if (link != links_.end()) {
      apply_each(block, "gazebo link", [&](const Node& node) {
        apply_to_link(node, model_.links[link->second], assets_);
      });
    } else if (joint != joints_.end()) {
      apply_each(block, "gazebo joint",
                 [&](const Node& node) { apply_to_joint(node, model_.joints[joint->second]); });
    } else if (reference.empty()) {
      apply_each(block, "gazebo robot", [this](const Node& node) { apply_to_model(node); });
    } else {
      assets_.log().warn(block.source(),
                         "found no link or joint that it refers to, expected one; it is left out",
                         ": '" + reference + "'");
    }
  }

 private:
  template <typename Apply>
  void apply_each(const Node& block, const char* place, Apply apply) {
    gazebo_schema().check(block, place, assets_.log());
    block.each(apply);
  }

  void apply_to_model(const Node& node) {
    const std::string_view name = node.name();
    if (name == "plugin") {
      model_.plugins.push_back(read_plugin(node));
    } else if (name == "joint") {
      // An SDF joint, by which robots close kinematic loops that URDF's tree cannot have.
      if (!joint_scope_) joint_scope_.emplace(106, frames_, model_);
      if (node.attribute("type") == "gearbox") {
        read_sdf_gearbox(node, *joint_scope_, assets_.log(), model_);
        return;
      }
      model_.joints.push_back(read_sdf_joint(node, *joint_scope_, assets_.log()));
      joints_.emplace(model_.joints.back().name, model_.joints.size() - 1);
    } else if (is_empty(node)) {
      return;
    } else if (name == "allow_auto_disable") {
      model_.allow_auto_disable = node.to_boolean();
    } else if (name == "static") {
      model_.is_static = node.to_boolean();
    } else if (name == "selfCollide" || name == "self_collide") {
      model_.self_collide = node.to_boolean();
      for (Link& link : model_.links) link.self_collide = link.self_collide || model_.self_collide;
    }
  }

  Model& model_;
  Assets& assets_;
  SdfFrames frames_;
  std::optional<JointScope> joint_scope_;
  std::unordered_map<std::string, std::size_t> links_;
  std::unordered_map<std::string, std::size_t> joints_;
};

}  // namespace

void apply_gazebo_blocks(const Node& root, Model& model, Assets& assets) {
  GazeboBlocks blocks(model, assets);
  root.each("gazebo", [&blocks](const Node& block) { blocks.apply(block); });
}

}  // namespace ardee
