// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/schema.h"

#include <sstream>

namespace ardee {
namespace {

/// Where one name means two things (<physics> of a world and of a joint) the line holds what either
/// may have.
constexpr const char* kSdf = R"(
sdf: world model light actor
gazebo: world model light
world: audio wind include gravity magnetic_field atmosphere gui physics scene light frame model actor plugin road spherical_coordinates state population joint
population: model pose frame box cylinder model_count distribution
distribution: type rows cols step
include: uri pose name static frame plugin ardee:scale ardee:label
physics: provide_feedback max_step_size real_time_factor real_time_update_rate update_rate max_contacts gravity magnetic_field ode bullet simbody dart
ode: solver constraints mu mu2 fdir1 slip1 slip2 soft_cfm soft_erp kp kd max_vel min_depth provide_feedback cfm_damping implicit_spring_damper fudge_factor cfm erp bounce max_force velocity limit suspension
solver: type dt min_step_size iters precon_iters sor use_dynamic_moi_rescaling friction_model island_threads thread_position_correction solver_type
constraints: cfm erp contact_max_correcting_vel contact_surface_layer split_impulse split_impulse_penetration_threshold
limit: cfm erp lower upper effort velocity stiffness dissipation
suspension: cfm erp
scene: ambient background sky shadows fog grid origin_visual
sky: time sunrise sunset clouds
clouds: speed direction humidity mean_size ambient
fog: color type start end density
gui: camera plugin
light: cast_shadows diffuse specular attenuation direction spot pose frame
attenuation: range linear constant quadratic
spot: inner_angle outer_angle falloff
spherical_coordinates: surface_model world_frame_orientation latitude_deg longitude_deg elevation heading_deg
model: static self_collide allow_auto_disable enable_wind include model link joint plugin gripper pose frame ardee:instances
link: gravity enable_wind self_collide kinematic must_be_base_link velocity_decay inertial collision visual sensor projector audio_sink audio_source battery light pose frame
velocity_decay: linear angular
inertial: mass pose frame inertia density
inertia: ixx ixy ixz iyy iyz izz
collision: laser_retro max_contacts surface geometry pose frame
visual: cast_shadows laser_retro transparency meta material geometry plugin pose frame
meta: layer
material: script shader lighting ambient diffuse specular emissive
script: uri name
shader: normal_map
geometry: empty box sphere cylinder plane mesh heightmap image polyline
box: size
sphere: radius
cylinder: radius length
plane: normal size
mesh: uri filename submesh scale
submesh: name center
heightmap: uri size pos texture blend use_terrain_paging sampling
texture: size diffuse normal
blend: min_height fade_dist
image: uri scale threshold height granularity
polyline: point height
surface: bounce friction contact soft_contact
bounce: restitution_coefficient threshold
friction: torsional ode bullet
torsional: coefficient use_patch_radius patch_radius surface_radius ode
contact: collide_without_contact collide_without_contact_bitmask collide_bitmask category_bitmask poissons_ratio elastic_modulus ode bullet
joint: parent child gearbox_ratio gearbox_reference_body thread_pitch axis axis2 physics sensor pose frame
axis: xyz use_parent_model_frame initial_position dynamics limit
axis2: xyz use_parent_model_frame initial_position dynamics limit
dynamics: damping friction spring_reference spring_stiffness
)";

constexpr const char* kUrdf = R"(
robot: link joint material gazebo transmission sensor
link: inertial visual collision verbose self_collision_checking
inertial: origin mass inertia
visual: origin geometry material
collision: origin geometry verbose contact_coefficients
geometry: box cylinder sphere mesh
material: color texture
joint: origin parent child axis calibration dynamics limit mimic safety_controller hardwareInterface
)";

bool is_foreign(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon != std::string_view::npos && name.substr(0, colon) != "ardee";
}

}  // namespace

Schema::Schema(const char* table) {
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) continue;
    std::istringstream words(line.substr(colon + 2));
    auto& names = children_[line.substr(0, colon)];
    for (std::string word; words >> word;) names.insert(word);
  }
}

void Schema::warn_of_unknown(const Node& node, const char* format, Log& log) const {
  const auto known = children_.find(std::string(node.name()));
  if (known == children_.end()) return;
  node.each([&](const Node& child) {
    if (known->second.count(child.name()) != 0) {
      warn_of_unknown(child, format, log);
    } else if (!is_foreign(child.name())) {
      log.warn(child.source(),
               "not an element of <" + std::string(node.name()) + "> in " + format + ", ignored");
    }
  });
}

const Schema& sdf_schema() {
  static const Schema schema(kSdf);
  return schema;
}

const Schema& urdf_schema() {
  static const Schema schema(kUrdf);
  return schema;
}

}  // namespace ardee
