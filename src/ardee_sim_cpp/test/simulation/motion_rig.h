// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "fixture.h"

namespace ardee {
using namespace devices;

/// Returns a world without ground, with a gravity along z.
inline std::string free_space(double gravity_m_per_s2) {
  return "<gravity>0 0 " + std::to_string(gravity_m_per_s2) + "</gravity>";
}

/// Returns a ball of 1 kg and 1 kg m^2 (it spins without bound) with a plugin on its link "body"
/// and, 1 m in front, a link "nose" on a fixed joint, rolled by 90 degrees.
inline std::string ball(const std::string& plugin, const std::string& in_model = "",
                        const std::string& in_link = "") {
  const std::string inertial =
      "<inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz><ixy>0</ixy>"
      "<ixz>0</ixz><iyz>0</iyz></inertia></inertial>";
  const std::string light =
      "<inertial><mass>1e-9</mass><inertia><ixx>1e-12</ixx><iyy>1e-12</iyy><izz>1e-12</izz>"
      "<ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>";
  return "<sdf version='1.6'><model name='ball'>" + in_model + "<link name='body'>" + inertial +
         in_link + "</link><link name='nose'><pose>1 0 0 1.5707963267948966 0 0</pose>" + light +
         "</link><joint name='neck' type='fixed'><parent>body</parent><child>nose</child></joint>" +
         plugin + "</model></sdf>";
}

inline std::string plugin(const std::string& library, const std::string& keys,
                          const std::string& name = "unit") {
  return "<plugin name='" + name + "' filename='lib" + library + ".so'>" + keys + "</plugin>";
}

/// Returns a ball that does not move.
inline std::string still(const std::string& plugin) {
  return ball(plugin, "<static>true</static>");
}

/// Returns the service of that name of any of the robot's devices; throws if there is none.
inline const Service& service(const Entity& robot, const std::string& name) {
  for (const auto& device : robot.devices) {
    for (const Service& each : device->ports().all<Service>()) {
      if (each.name == name) return each;
    }
  }
  throw std::runtime_error("no service " + name);
}

inline const ParameterGroup& tuning(const Entity& robot, const std::string& name) {
  for (const auto& device : robot.devices) {
    for (const ParameterGroup& each : device->ports().all<ParameterGroup>()) {
      if (each.name == name) return each;
    }
  }
  throw std::runtime_error("no tuning " + name);
}

inline void set(const ParameterGroup& tuning, const std::string& name, double value) {
  for (const TunableParameter& each : tuning.parameters) {
    if (each.name == name) return each.set(value);
  }
  throw std::runtime_error("no parameter " + name);
}

inline void expect_near(const Eigen::Vector3d& found, const Eigen::Vector3d& expected,
                        double tolerance) {
  EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), tolerance)
      << "found " << found.transpose() << ", expected " << expected.transpose();
}

}  // namespace ardee
