// SPDX-License-Identifier: MIT
#include "ros/physics_tuning.h"

#include <ros/console.h>

#include <cmath>

namespace ardee::node {
namespace {

constexpr double kMostCount = 10000.0;

/// A number of Gazebo that this engine lacks: always 0.
devices::TunableParameter inert(const char* name, devices::TunableParameter::Type type,
                                double high) {
  const auto get = [] { return 0.0; };
  const auto set = [](double) { warn_of_inert_physics(); };
  return {name, "without effect", type, 0.0, high, 0.0, get, set};
}

const devices::TunableParameter& require(const devices::ParameterGroup& tuning,
                                         const std::string& name) {
  for (const devices::TunableParameter& each : tuning.parameters) {
    if (each.name == name) return each;
  }
  throw Error("found the parameter '" + name + "', expected one of Physics.cfg");
}

}  // namespace

void warn_of_inert_physics() {
  ROS_WARN_ONCE(
      "auto_disable_bodies, sor_pgs_precon_iters and sor_pgs_rms_error_tol have no effect: each "
      "model's <allow_auto_disable> says whether it sleeps, and the solver takes all its "
      "iterations without preconditioning");
}

devices::TunableParameter PhysicsTuning::number(const char* name, const char* unit, double high,
                                                double initial, double PhysicsParams::*field) {
  const auto get = [this, field] { return context_.simulation.physics().*field; };
  const auto set = [this, field](double value) { wanted_.*field = value; };
  return {name, unit, devices::TunableParameter::Type::kDouble, 0.0, high, initial, get, set};
}

devices::TunableParameter PhysicsTuning::count(const char* name, double initial,
                                               int PhysicsParams::*field) {
  const auto get = [this, field] { return double(context_.simulation.physics().*field); };
  const auto set = [this, field](double value) { wanted_.*field = static_cast<int>(value); };
  return {name, "", devices::TunableParameter::Type::kInt, 0.0, kMostCount, initial, get, set};
}

devices::TunableParameter PhysicsTuning::gravity(const char* name, Eigen::Index axis,
                                                 double initial) {
  constexpr double kMost_m_per_s2 = 100.0;
  const auto get = [this, axis] { return context_.simulation.physics().gravity_m_per_s2[axis]; };
  const auto set = [this, axis](double value) { wanted_.gravity_m_per_s2[axis] = value; };
  return {name,
          "m/s^2",
          devices::TunableParameter::Type::kDouble,
          -kMost_m_per_s2,
          kMost_m_per_s2,
          initial,
          get,
          set};
}

devices::ParameterGroup PhysicsTuning::describe(const std::string& space) {
  using P = PhysicsParams;
  using Type = devices::TunableParameter::Type;
  return {
      space,
      {number("time_step", "s", 10.0, 0.001, &P::step_s),
       number("max_update_rate", "steps a second of wall time, 0: as fast as it goes", 1e4, 1000.0,
              &P::real_time_update_rate_hz),
       gravity("gravity_x", 0, 0.0), gravity("gravity_y", 1, 0.0), gravity("gravity_z", 2, -9.8),
       inert("auto_disable_bodies", Type::kBool, 1.0),
       inert("sor_pgs_precon_iters", Type::kInt, kMostCount),
       count("sor_pgs_iters", 50, &P::iterations),
       inert("sor_pgs_rms_error_tol", Type::kDouble, 1e3),
       number("sor_pgs_w", "over-relaxation", 5.0, 1.3, &P::sor),
       number("contact_surface_layer", "m", 10.0, 0.001, &P::contact_surface_layer_m),
       number("contact_max_correcting_vel", "m/s", 1e3, 100.0, &P::max_correcting_velocity_m_per_s),
       number("cfm", "", 10.0, 0.0, &P::cfm), number("erp", "", 10.0, 0.2, &P::erp),
       count("max_contacts", 20, &P::max_contacts)}};
}

PhysicsTuning::PhysicsTuning(const std::string& space, ServiceContext& context)
    : context_(context),
      tuning_(describe(space)),
      server_(node_, tuning_, [this](const auto& values) { set(values); }) {}

void PhysicsTuning::set(const TuningServer::Values& values) {
  wanted_ = context_.simulation.physics();
  for (const auto& [name, value] : values) {
    const devices::TunableParameter& asked = require(tuning_, name);
    // A client that sends all numbers to change one may return numbers of the world beyond the
    // range.
    if (value == asked.get()) continue;
    if (asked.type == devices::TunableParameter::Type::kInt && value != std::floor(value)) {
      throw Error(name + ": found " + std::to_string(value) + ", expected a whole number");
    }
    asked.set(checked(name, value, asked.low, asked.high));
  }
  context_.simulation.set_physics(wanted_);
  context_.runner.follow_physics();
}

}  // namespace ardee::node
