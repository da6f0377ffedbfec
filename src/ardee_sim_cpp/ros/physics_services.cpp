// SPDX-License-Identifier: MIT
#include <gazebo_msgs/GetPhysicsProperties.h>
#include <gazebo_msgs/SetPhysicsProperties.h>

#include <memory>

#include "ardee_sim/description/bounds.h"
#include "ros/conversions.h"
#include "ros/physics_tuning.h"
#include "ros/services.h"

namespace ardee::node {
namespace {

std::string get_physics(ServiceContext& context,
                        gazebo_msgs::GetPhysicsPropertiesResponse& response) {
  const PhysicsParams& physics = context.simulation.physics();
  response.time_step = physics.step_s;
  response.pause = context.runner.paused();
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

/// A number of a request. The values of get_physics_properties are always accepted: only a number
/// that differs from the one in force must lie within the range.
void change(const char* field, double asked, const bounds::Range& range, double& in_force) {
  if (asked != in_force) in_force = checked(field, asked, range.low, range.high);
}

/// A count of a request, checked as a number; 0 (an unset field) keeps the one in force.
void change(const char* field, std::uint32_t asked, const bounds::Range& range, int& in_force) {
  double count = in_force;
  if (asked != 0) change(field, static_cast<double>(asked), range, count);
  in_force = static_cast<int>(count);
}

void set_ode(const gazebo_msgs::ODEPhysics& ode, PhysicsParams& physics) {
  change("ode_config.sor_pgs_iters", ode.sor_pgs_iters, bounds::kIterations, physics.iterations);
  change("ode_config.max_contacts", ode.max_contacts, bounds::kMaxContacts, physics.max_contacts);
  if (ode.sor_pgs_w != 0.0) {
    change("ode_config.sor_pgs_w", ode.sor_pgs_w, bounds::kRelaxation, physics.sor);
  }
  change("ode_config.contact_surface_layer", ode.contact_surface_layer, bounds::kSurfaceLayer_m,
         physics.contact_surface_layer_m);
  change("ode_config.contact_max_correcting_vel", ode.contact_max_correcting_vel,
         bounds::kCorrectingVelocity, physics.max_correcting_velocity_m_per_s);
  change("ode_config.cfm", ode.cfm, bounds::kCfm, physics.cfm);
  change("ode_config.erp", ode.erp, bounds::kErp, physics.erp);
  checked("ode_config.sor_pgs_rms_error_tol", ode.sor_pgs_rms_error_tol, 0.0, bounds::kInfinity);
  if (ode.auto_disable_bodies || ode.sor_pgs_precon_iters > 0 || ode.sor_pgs_rms_error_tol > 0.0) {
    warn_of_inert_physics();
  }
}

std::string set_physics(ServiceContext& context,
                        const gazebo_msgs::SetPhysicsPropertiesRequest& request) {
  PhysicsParams physics = context.simulation.physics();
  change("time_step", request.time_step, bounds::kStep_s, physics.step_s);
  change("max_update_rate", request.max_update_rate, bounds::kUpdateRate_hz,
         physics.real_time_update_rate_hz);
  physics.gravity_m_per_s2 = from_ros(request.gravity);
  set_ode(request.ode_config, physics);
  context.simulation.set_physics(physics);
  context.runner.follow_physics();
  return "physics engine updated";
}

}  // namespace

void add_physics_services(ServiceServers& servers, ServiceContext& context) {
  const auto tuning = std::make_shared<PhysicsTuning>(servers.space(), context);
  servers.add<gazebo_msgs::GetPhysicsProperties>(
      "get_physics_properties", "GetPhysicsProperties",
      [&context](const auto&, auto& response) { return get_physics(context, response); });
  servers.add<gazebo_msgs::SetPhysicsProperties>("set_physics_properties", "SetPhysicsProperties",
                                                 [&context, tuning](const auto& request, auto&) {
                                                   const std::string done =
                                                       set_physics(context, request);
                                                   tuning->publish();
                                                   return done;
                                                 });
}

}  // namespace ardee::node
