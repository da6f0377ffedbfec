// SPDX-License-Identifier: MIT
#include <limits>
#include <map>
#include <utility>

#include "ardee_sim/core/limits.h"
#include "ardee_sim/description/bounds.h"
#include "ardee_sim/readers/urdf.h"

namespace ardee {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Type of a joint; none if nothing holds the child.
std::optional<JointType> read_type(const Node& joint) {
  static const std::map<std::string, std::optional<JointType>> types{
      {"fixed", JointType::kFixed},
      {"revolute", JointType::kRevolute},
      {"continuous", JointType::kContinuous},
      {"prismatic", JointType::kPrismatic},
      {"floating", std::nullopt},
      {"planar", std::nullopt}};
  const std::string type = joint.required_attribute("type");
  const auto found = types.find(type);
  if (found != types.end()) return found->second;
  throw joint.error("found joint type '" + type +
                    "', expected fixed, revolute, continuous, prismatic, floating or planar");
}

/// Exporters write effort="0" velocity="0" for unknown limits, as URDF requires the attributes;
/// Gazebo's drives still turn such wheels.
double unlimited_unless_positive(const Node& limit, const char* name) {
  limit.required_attribute(name);
  const double value = limit.attribute_number(name, 0.0, -kInfinity, kInfinity);
  return value > 0.0 ? value : kInfinity;
}

void read_limit(const Node& node, const std::string& type, Joint& joint, Log& log) {
  const auto limit = node.child("limit");
  const bool ends = type == "revolute" || type == "prismatic";
  if (!limit && ends) {
    throw node.error("found no <limit> in a " + type + " joint, expected one");
  }
  if (!limit) return;
  joint.axis.effort = unlimited_unless_positive(*limit, "effort");
  joint.axis.velocity = unlimited_unless_positive(*limit, "velocity");
  double lower = limit->attribute_number("lower", 0.0, -kInfinity, kInfinity);
  double upper = limit->attribute_number("upper", 0.0, -kInfinity, kInfinity);
  if (!ends) return;
  if (lower > upper) {
    log.warn(limit->source(), "found a lower limit above the upper; they change places");
    std::swap(lower, upper);
  }
  joint.axis.lower = lower;
  joint.axis.upper = upper;
}

Eigen::Vector3d axis_vector(const Node& joint) {
  const auto node = joint.child("axis");
  if (!node) return Eigen::Vector3d::UnitX();
  const Eigen::Vector3d axis = node->attribute_vector3("xyz", Eigen::Vector3d::UnitX());
  if (axis.norm() > 1e-9) return axis.normalized();
  throw node->error("found '" + node->attribute("xyz") + "', expected an axis longer than zero");
}

/// Springs are not part of URDF, but some files have them for Gazebo.
void read_dynamics(const Node& node, JointAxis& axis) {
  const auto dynamics = node.child("dynamics");
  if (!dynamics) return;
  const auto read = [&dynamics](const char* name, const bounds::Range& range) {
    return dynamics->attribute_number(name, 0.0, range.low, range.high);
  };
  axis.damping = read("damping", bounds::kJointCoefficient);
  axis.friction = read("friction", bounds::kJointCoefficient);
  axis.spring_stiffness = read("spring_stiffness", bounds::kJointCoefficient);
  axis.spring_reference = read("spring_reference", bounds::kJointReference);
}

/// A safety controller without its required gain is left out.
std::optional<SafetyLimits> read_safety(const Node& joint, Log& log) {
  const auto node = joint.child("safety_controller");
  if (!node) return std::nullopt;
  try {
    node->required_attribute("k_velocity");
    const auto read = [&node](const char* name) { return node->attribute_number(name, 0.0); };
    return SafetyLimits{read("soft_lower_limit"), read("soft_upper_limit"), read("k_position"),
                        read("k_velocity")};
  } catch (const Error& error) {
    log.error(std::string(error.what()) + "; the <safety_controller> is left out");
    return std::nullopt;
  }
}

}  // namespace

UrdfJoint read_urdf_joint(const Node& node, Log& log) {
  UrdfJoint made;
  made.joint.name = node.required_attribute("name");
  made.joint.source = node.source();
  made.joint.parent = node.required("parent").required_attribute("link");
  made.joint.child = node.required("child").required_attribute("link");
  made.X_PC = read_urdf_origin(node);
  const auto type = read_type(node);
  const std::string type_name = node.attribute("type");
  made.is_free = !type;
  made.joint.type = type.value_or(JointType::kFixed);
  if (type_name == "planar") {
    log.warn(node.source(), "planar joints are not supported, the child moves freely");
  }
  if (made.joint.type == JointType::kFixed) return made;
  made.joint.axis.axis = axis_vector(node);
  read_limit(node, type_name, made.joint, log);
  read_dynamics(node, made.joint.axis);
  made.joint.safety = read_safety(node, log);
  if (const auto mimic = node.child("mimic")) {
    made.mimic.emplace();
    made.mimic->leader = mimic->required_attribute("joint");
    made.mimic->follower = made.joint.name;
    made.mimic->multiplier =
        mimic->attribute_number("multiplier", 1.0, -limits::kMostFactor, limits::kMostFactor);
    made.mimic->offset =
        mimic->attribute_number("offset", 0.0, -limits::kMostTravel, limits::kMostTravel);
    made.mimic->source = mimic->source();
  }
  return made;
}

}  // namespace ardee
