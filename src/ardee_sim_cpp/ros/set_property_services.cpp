// SPDX-License-Identifier: MIT
#include <gazebo_msgs/SetJointProperties.h>
#include <gazebo_msgs/SetLinkProperties.h>

#include <cmath>
#include <limits>

#include "ardee_sim/core/limits.h"
#include "ros/conversions.h"
#include "ros/services.h"

namespace ardee::node {
namespace {

constexpr double kLarge = 1e9;  // kg, kg m^2, rad/s: beyond any robot's

double checked_moment(const char* field, double value) {
  return checked(field, value, -kLarge, kLarge);
}

std::string set_link(ServiceContext& context,
                     const gazebo_msgs::SetLinkPropertiesRequest& request) {
  const LinkRef ref = require_link(context, request.link_name);
  physics::PhysicsModel& dynamics = ref.entity.robot->dynamics();
  Inertial inertial;
  inertial.X_LI = from_ros(request.com);
  for (const double part_m : inertial.X_LI.p) {
    checked("com", part_m, -limits::kFarthest_m, limits::kFarthest_m);
  }
  inertial.mass_kg = checked("mass", request.mass, std::numeric_limits<double>::min(), kLarge);
  const double ixy = checked_moment("ixy", request.ixy);
  const double ixz = checked_moment("ixz", request.ixz);
  const double iyz = checked_moment("iyz", request.iyz);
  inertial.inertia_kg_m2 << checked_moment("ixx", request.ixx), ixy, ixz,  //
      ixy, checked_moment("iyy", request.iyy), iyz,                        //
      ixz, iyz, checked_moment("izz", request.izz);
  physics::LinkProperties properties;
  properties.inertial = inertial;
  properties.gravity = request.gravity_mode;
  dynamics.set_link_properties(ref.link, properties);
  return "SetLinkProperties: properties set";
}

/// Properties and motor of one axis.
struct Axis {
  physics::JointProperties properties;
  physics::JointMotor motor;
};

std::vector<Axis> axes_of(const physics::PhysicsModel& dynamics, std::size_t joint) {
  std::vector<Axis> axes;
  for (std::size_t axis = 0; axis < dynamics.joint_axes(joint); ++axis) {
    axes.push_back({dynamics.joint_properties(joint, axis), dynamics.joint_motor(joint, axis)});
  }
  return axes;
}

/// Sets all values or none.
void set_axes(physics::PhysicsModel& dynamics, std::size_t joint, const std::vector<Axis>& wanted) {
  const auto set = [&](const std::vector<Axis>& axes) {
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
      dynamics.set_joint_properties(joint, axis, axes[axis].properties);
      dynamics.set_joint_motor(joint, axis, axes[axis].motor);
    }
  };
  const std::vector<Axis> before = axes_of(dynamics, joint);
  try {
    set(wanted);
  } catch (...) {
    set(before);
    throw;
  }
}

/// Writes a request's list, a number per axis, by `field(axis)`; an empty list changes nothing.
template <typename Field>
void write_list(const char* name, const std::vector<double>& list, std::vector<Axis>& axes,
                const Field& field) {
  if (list.size() > axes.size()) {
    throw Error(std::string(name) + ": found " + std::to_string(list.size()) +
                " numbers, expected at most one of each of the joint's " +
                std::to_string(axes.size()) + " axes");
  }
  for (std::size_t axis = 0; axis < list.size(); ++axis) field(axes[axis]) = list[axis];
}

std::string set_joint(ServiceContext& context,
                      const gazebo_msgs::SetJointPropertiesRequest& request) {
  const JointRef ref = require_joint(context, request.joint_name);
  physics::PhysicsModel& dynamics = ref.entity.robot->dynamics();
  const gazebo_msgs::ODEJointProperties& asked = request.ode_joint_config;
  std::vector<Axis> axes = axes_of(dynamics, ref.joint);
  using A = Axis;
  const auto damping = [](A& a) -> double& { return a.properties.spring.damping; };
  const auto upper = [](A& a) -> double& { return a.properties.upper; };
  const auto lower = [](A& a) -> double& { return a.properties.lower; };
  const auto motor_cfm = [](A& a) -> double& { return a.properties.motor_cfm; };
  const auto stop_erp = [](A& a) -> double& { return a.properties.stop_erp; };
  const auto stop_cfm = [](A& a) -> double& { return a.properties.stop_cfm; };
  const auto most_effort = [](A& a) -> double& { return a.motor.max_effort; };
  const auto speed = [](A& a) -> double& { return a.motor.velocity; };
  write_list("damping", asked.damping, axes, damping);
  write_list("hiStop", asked.hiStop, axes, upper);
  write_list("loStop", asked.loStop, axes, lower);
  write_list("cfm", asked.cfm, axes, motor_cfm);
  write_list("stop_erp", asked.stop_erp, axes, stop_erp);
  write_list("stop_cfm", asked.stop_cfm, axes, stop_cfm);
  write_list("fmax", asked.fmax, axes, most_effort);
  write_list("vel", asked.vel, axes, speed);
  set_axes(dynamics, ref.joint, axes);
  const bool has_inert = !asked.erp.empty() || !asked.fudge_factor.empty();
  return std::string("SetJointProperties: properties set") +
         (has_inert ? "; erp and fudge_factor have no effect here" : "");
}

}  // namespace

void add_set_property_services(ServiceServers& servers, ServiceContext& context) {
  servers.add<gazebo_msgs::SetLinkProperties>(
      "set_link_properties", "SetLinkProperties",
      [&context](const auto& request, auto&) { return set_link(context, request); });
  servers.add<gazebo_msgs::SetJointProperties>(
      "set_joint_properties", "SetJointProperties",
      [&context](const auto& request, auto&) { return set_joint(context, request); });
}

}  // namespace ardee::node
