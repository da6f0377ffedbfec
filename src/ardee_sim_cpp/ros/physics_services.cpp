// SPDX-License-Identifier: MIT
#include <gazebo_msgs/GetPhysicsProperties.h>
#include <gazebo_msgs/SetPhysicsProperties.h>

#include <memory>

#include "ros/conversions.h"
#include "ros/physics_tuning.h"
#include "ros/services.h"

namespace ardee::node {
namespace {

std::string get_physics(Stage& stage, gazebo_msgs::GetPhysicsPropertiesResponse& response) {
  const PhysicsParams& physics = stage.simulation.physics();
  response.time_step = physics.step_s;
  response.pause = stage.runner.paused();
  response.max_update_rate = physics.real_time_update_rate_hz;
  response.gravity = to_vector(physics.gravity_m_per_s2);
  response.ode_config.auto_disable_bodies = false;
  response.ode_config.sor_pgs_iters = static_cast<std::uint32_t>(physics.iterations);
  response.ode_config.sor_pgs_w = physics.sor;
  response.ode_config.contact_surface_layer = physics.contact_surface_layer_m;
  response.ode_config.contact_max_correcting_vel = physics.max_correcting_velocity_m_per_s;
  response.ode_config.cfm = physics.cfm;
  response.ode_config.erp = physics.erp;
  response.ode_config.max_contacts = static_cast<std::uint32_t>(physics.max_contacts);
  return "GetPhysicsProperties: got properties";
}

/// A value below 1 (a field nobody filled in) leaves what is in force.
int checked_count(const char* field, std::uint32_t value, int in_force) {
  constexpr double kMost = 10000;
  return value == 0 ? in_force : static_cast<int>(checked(field, value, 1, kMost));
}

std::string set_physics(Stage& stage, const gazebo_msgs::SetPhysicsPropertiesRequest& request) {
  constexpr double kLarge = 1e9;
  PhysicsParams physics = stage.simulation.physics();
  physics.step_s = checked("time_step", request.time_step, 1e-6, 1.0);
  physics.real_time_update_rate_hz =
      checked("max_update_rate", request.max_update_rate, 0.0, kLarge);
  physics.gravity_m_per_s2 = from_ros(request.gravity);
  for (const double g : physics.gravity_m_per_s2) checked("gravity", g, -1e6, 1e6);
  const gazebo_msgs::ODEPhysics& ode = request.ode_config;
  physics.iterations =
      checked_count("ode_config.sor_pgs_iters", ode.sor_pgs_iters, physics.iterations);
  physics.max_contacts =
      checked_count("ode_config.max_contacts", ode.max_contacts, physics.max_contacts);
  if (ode.sor_pgs_w != 0.0) physics.sor = checked("ode_config.sor_pgs_w", ode.sor_pgs_w, 0.01, 2.0);
  physics.contact_surface_layer_m =
      checked("ode_config.contact_surface_layer", ode.contact_surface_layer, 0.0, 1.0);
  physics.max_correcting_velocity_m_per_s =
      checked("ode_config.contact_max_correcting_vel", ode.contact_max_correcting_vel, 0.0, kLarge);
  physics.cfm = checked("ode_config.cfm", ode.cfm, 0.0, kLarge);
  physics.erp = checked("ode_config.erp", ode.erp, 0.0, 1.0);
  checked("ode_config.sor_pgs_rms_error_tol", ode.sor_pgs_rms_error_tol, 0.0, kLarge);
  if (ode.auto_disable_bodies || ode.sor_pgs_precon_iters > 0 || ode.sor_pgs_rms_error_tol > 0.0) {
    warn_of_inert_physics();
  }
  stage.simulation.set_physics(physics);
  stage.runner.follow_physics();
  return "physics engine updated";
}

}  // namespace

void add_physics_services(ServiceServers& servers, Stage& stage) {
  const auto tuning = std::make_shared<PhysicsTuning>(servers.space(), stage);
  servers.add<gazebo_msgs::GetPhysicsProperties>(
      "get_physics_properties", "GetPhysicsProperties",
      [&stage](const auto&, auto& response) { return get_physics(stage, response); });
  servers.add<gazebo_msgs::SetPhysicsProperties>("set_physics_properties", "SetPhysicsProperties",
                                                 [&stage, tuning](const auto& request, auto&) {
                                                   const std::string done =
                                                       set_physics(stage, request);
                                                   tuning->publish();
                                                   return done;
                                                 });
}

}  // namespace ardee::node
