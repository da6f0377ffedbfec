// SPDX-License-Identifier: MIT
#include "ardee_sim/description/bounds.h"
#include "ardee_sim/readers/sdf_parts.h"

namespace ardee {
namespace {

/// The <physics> marked as default, else the first.
std::optional<Node> choose_physics(const Node& world) {
  std::optional<Node> chosen;
  bool marked = false;
  world.each("physics", [&](const Node& physics) {
    const std::string mark = physics.attribute("default");
    const bool is_default = mark == "1" || mark == "true";
    if (!chosen || (is_default && !marked)) chosen = physics;
    marked = marked || is_default;
  });
  return chosen;
}

PhysicsParams::Solver solver_type(const Node& physics) {
  const auto type = physics.find("ode/solver/type");
  if (!type || type->text() == "quick") return PhysicsParams::Solver::kQuick;
  if (type->text() == "world") return PhysicsParams::Solver::kWorld;
  throw type->error("found '" + type->text() + "', expected quick or world");
}

void read_ode(const Node& physics, PhysicsParams& made) {
  made.solver = solver_type(physics);
  const auto read = [&physics](const char* path, double fallback, const bounds::Range& range) {
    return physics.number(path, fallback, range.low, range.high);
  };
  made.iterations = physics.integer("ode/solver/iters", made.iterations,
                                    static_cast<int>(bounds::kIterations.low),
                                    static_cast<int>(bounds::kIterations.high));
  made.sor = read("ode/solver/sor", made.sor, bounds::kRelaxation);
  made.cfm = read("ode/constraints/cfm", made.cfm, bounds::kCfm);
  made.erp = read("ode/constraints/erp", made.erp, bounds::kErp);
  made.max_correcting_velocity_m_per_s =
      read("ode/constraints/contact_max_correcting_vel", made.max_correcting_velocity_m_per_s,
           bounds::kCorrectingVelocity);
  made.contact_surface_layer_m = read("ode/constraints/contact_surface_layer",
                                      made.contact_surface_layer_m, bounds::kSurfaceLayer_m);
}

/// Steps per second of wall time, 0: as fast as possible. Gazebo uses <real_time_update_rate>
/// alone, so a positive one counts. If it is 0 or absent (thesis Listing A.15), a given
/// <real_time_factor> is the author's intended pace.
double read_update_rate(const Node& physics, double step_s) {
  constexpr bounds::Range kRate = bounds::kUpdateRate_hz;
  const auto now = physics.child("real_time_update_rate");
  const auto written = now ? now : physics.child("update_rate");
  const double rate = written ? written->to_number(kRate.low, kRate.high) : 1.0 / step_s;
  if (written && rate > 0.0) return rate;
  const auto factor = physics.child("real_time_factor");
  return factor ? factor->to_number(kRate.low, kRate.high) / step_s : rate;
}

}  // namespace

PhysicsParams read_sdf_physics(const Node& world, Log& log) {
  PhysicsParams made;
  if (const auto physics = choose_physics(world)) {
    const std::string type = physics->attribute("type", "ode");
    if (type != "ode") {
      log.warn(physics->source().to_string() + ": found type '" + type + "', ode is used");
    }
    // SDF 1.2 and 1.3 used <ode><solver><dt> and <update_rate>.
    const double old_step =
        physics->number("ode/solver/dt", made.step_s, bounds::kStep_s.low, bounds::kStep_s.high);
    made.step_s =
        physics->number("max_step_size", old_step, bounds::kStep_s.low, bounds::kStep_s.high);
    made.real_time_update_rate_hz = read_update_rate(*physics, made.step_s);
    made.max_contacts = physics->integer("max_contacts", made.max_contacts,
                                         static_cast<int>(bounds::kMaxContacts.low),
                                         static_cast<int>(bounds::kMaxContacts.high));
    made.gravity_m_per_s2 = physics->vector3("gravity", made.gravity_m_per_s2);
    read_ode(*physics, made);
  }
  made.gravity_m_per_s2 = world.vector3("gravity", made.gravity_m_per_s2);
  return made;
}

Light read_sdf_light(const Node& light, const Pose& X_WL) {
  Light made;
  made.name = light.required_attribute("name");
  const std::string type = light.required_attribute("type");
  if (type == "point") {
    made.type = Light::Type::kPoint;
  } else if (type == "spot") {
    made.type = Light::Type::kSpot;
  } else if (type != "directional") {
    throw light.error("found type '" + type + "', expected directional, point or spot");
  }
  made.pose = X_WL;
  made.diffuse = light.color("diffuse", made.diffuse);
  made.specular = light.color("specular", made.specular);
  made.direction = light.vector3("direction", made.direction);
  const bool has_length = made.direction.norm() > 1e-9;
  if (!has_length && made.type != Light::Type::kPoint) {
    throw light.error("found a direction of length zero, expected another");
  }
  if (has_length) made.direction.normalize();
  made.cast_shadows = light.boolean("cast_shadows", made.cast_shadows);
  made.range_m = light.number("attenuation/range", made.range_m, 0.0);
  made.attenuation_constant = light.number("attenuation/constant", made.attenuation_constant, 0.0);
  made.attenuation_linear = light.number("attenuation/linear", made.attenuation_linear, 0.0);
  made.attenuation_quadratic =
      light.number("attenuation/quadratic", made.attenuation_quadratic, 0.0);
  made.inner_angle_rad = light.number("spot/inner_angle", 0.0, 0.0, 7.0);
  made.outer_angle_rad = light.number("spot/outer_angle", 0.0, 0.0, 7.0);
  made.falloff = light.number("spot/falloff", 0.0, 0.0);
  return made;
}

Scene read_sdf_scene(const Node& scene) {
  Scene made;
  made.ambient = scene.color("ambient", made.ambient);
  made.background = scene.color("background", made.background);
  made.sky = scene.child("sky").has_value();
  made.shadows = scene.boolean("shadows", made.shadows);
  return made;
}

SphericalCoordinates read_spherical_coordinates(const Node& coordinates) {
  SphericalCoordinates made;
  made.latitude_deg = coordinates.number("latitude_deg", 0.0, -90.0, 90.0);
  made.longitude_deg = coordinates.number("longitude_deg", 0.0, -360.0, 360.0);
  made.elevation_m = coordinates.number("elevation", 0.0);
  made.heading_deg = coordinates.number("heading_deg", 0.0, -360.0, 360.0);
  return made;
}

}  // namespace ardee
