// SPDX-License-Identifier: MIT
#include <cmath>
#include <map>

#include "ardee_sim/description/bounds.h"
#include "ardee_sim/readers/sdf_parts.h"
#include "ardee_sim/readers/validate.h"

namespace ardee {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

JointType joint_type(const Node& joint) {
  static const std::map<std::string, JointType> types{{"fixed", JointType::kFixed},
                                                      {"revolute", JointType::kRevolute},
                                                      {"continuous", JointType::kContinuous},
                                                      {"prismatic", JointType::kPrismatic},
                                                      {"ball", JointType::kBall},
                                                      {"universal", JointType::kUniversal},
                                                      {"revolute2", JointType::kRevolute2},
                                                      {"screw", JointType::kScrew}};
  const std::string type = joint.required_attribute("type");
  const auto found = types.find(type);
  if (found != types.end()) return found->second;
  throw joint.error("found joint type '" + type +
                    "', expected fixed, revolute, continuous, prismatic, ball, universal, "
                    "revolute2, screw or gearbox");
}

/// The frame that an axis is given in: SDF 1.7 names it by expressed_in, older files say
/// <use_parent_model_frame>; empty: the joint's.
std::string frame_of_axis(const Node& axis, int sdf_version) {
  constexpr int kFirstInJointFrame = 105;
  const auto xyz = axis.child("xyz");
  const std::string named = xyz ? xyz->attribute("expressed_in") : "";
  if (!named.empty()) return named;
  return axis.boolean("use_parent_model_frame", sdf_version < kFirstInJointFrame) ? "__model__"
                                                                                  : "";
}

/// A negative value means "no limit" in SDF.
double unlimited_if_negative(const Node& axis, const char* path) {
  const double value = axis.limit(path, kInfinity);
  return value < 0.0 ? kInfinity : value;
}

JointAxis read_axis(const Node& axis) {
  JointAxis made;
  made.axis = axis.vector3("xyz", Eigen::Vector3d::UnitZ());
  if (!(made.axis.norm() > 1e-9)) {
    throw axis.required("xyz").error("found '" + axis.text("xyz", "") +
                                     "', expected an axis longer than zero");
  }
  made.axis.normalize();
  made.lower = axis.limit("limit/lower", made.lower);
  made.upper = axis.limit("limit/upper", made.upper);
  if (made.lower > made.upper) {
    throw axis.required("limit").error("found a lower limit above the upper, expected it below");
  }
  made.effort = unlimited_if_negative(axis, "limit/effort");
  made.velocity = unlimited_if_negative(axis, "limit/velocity");
  const auto read = [&axis](const char* path, const bounds::Range& range) {
    return axis.number(path, 0.0, range.low, range.high);
  };
  made.damping = read("dynamics/damping", bounds::kJointCoefficient);
  made.friction = read("dynamics/friction", bounds::kJointCoefficient);
  made.spring_stiffness = read("dynamics/spring_stiffness", bounds::kJointCoefficient);
  made.spring_reference = read("dynamics/spring_reference", bounds::kJointReference);
  return made;
}

/// The name of a link or frame as the model knows it: "model::link" may name its own scope.
std::string without_own_scope(const std::string& name, const JointScope& scope) {
  const std::string own = scope.model.name + "::";
  const bool is_nested = scope.X_ML.count(scope.frames.body_of(name)) != 0;
  return !is_nested && name.compare(0, own.size(), own) == 0 ? name.substr(own.size()) : name;
}

/// The link that a frame moves with.
std::string link_of(const std::string& frame, const JointScope& scope) {
  const std::string body = scope.frames.body_of(frame);
  return body.empty() ? scope.model.canonical_link : body;
}

/// Places the joint by its <pose>, in the frame of its child by default, and returns its
/// orientation in the model.
Eigen::Quaterniond place(const Node& node, const std::string& child, const JointScope& scope,
                         Joint& joint) {
  const std::string& held = joint.child == "world" ? joint.parent : joint.child;
  const SdfFrames& frames = scope.frames;
  const auto link = scope.X_ML.find(held);
  if (link == scope.X_ML.end()) throw Error(joint.source, unknown_link(held, scope.model));
  const Pose& X_ML = link->second;
  if (joint.child == "world") {
    // The pose of such a joint is given in the model's frame.
    const Pose X_MJ = frames.pose(node);
    joint.X_CJ = X_ML.inverse() * X_MJ;
    std::swap(joint.parent, joint.child);
    joint.axis.axis = -joint.axis.axis;
    joint.axis2.axis = -joint.axis2.axis;
    return X_MJ.q;
  }
  joint.X_CJ = child == joint.child ? frames.pose_in(child, node)
                                    : X_ML.inverse() * frames.pose(node, child);
  return X_ML.q * joint.X_CJ.q;
}

}  // namespace

JointScope::JointScope(int version, const SdfFrames& known_frames, const Model& of)
    : sdf_version(version), frames(known_frames), model(of) {
  for (const Link& link : of.links) X_ML.emplace(link.name, link.X_ML);
}

Joint read_sdf_joint(const Node& node, const JointScope& scope, Log& log) {
  Joint joint;
  joint.name = node.required_attribute("name");
  joint.type = joint_type(node);
  joint.source = node.source();
  const std::string child = without_own_scope(node.required("child").required_text(), scope);
  const std::string parent = without_own_scope(node.required("parent").required_text(), scope);
  joint.parent = link_of(parent, scope);
  joint.child = link_of(child, scope);
  const bool free = axis_count(joint.type) == 0;
  const bool two = axis_count(joint.type) == 2;
  const auto axis = node.child("axis");
  if (!free && axis) joint.axis = read_axis(*axis);
  if (!free && !axis) log.warn(node.source(), "found no <axis>, expected one; it is 0 0 1");
  if (two) joint.axis2 = read_axis(node.required("axis2"));
  const bool unlimited = std::isinf(joint.axis.lower) && std::isinf(joint.axis.upper);
  if (joint.type == JointType::kRevolute && unlimited) joint.type = JointType::kContinuous;
  if (joint.type == JointType::kScrew) {
    // SDF's pitch counts radians a metre, of a left-handed screw.
    const double pitch_rad_per_m = node.number("thread_pitch", 1.0);
    if (pitch_rad_per_m == 0.0) throw node.error("found a thread pitch of zero, expected another");
    joint.thread_pitch_m = -2.0 * kPi / pitch_rad_per_m;
  }
  constexpr bounds::Range kSoftness = bounds::kJointSoftness;
  joint.stop_cfm = node.number("physics/ode/limit/cfm", -1.0, kSoftness.low, kSoftness.high);
  joint.stop_erp = node.number("physics/ode/limit/erp", -1.0, kSoftness.low, kSoftness.high);
  joint.is_measured = node.boolean("physics/provide_feedback", false) ||
                      node.boolean("physics/ode/provide_feedback", false);
  const Eigen::Quaterniond q_MJ = place(node, child, scope, joint);
  const auto turn = [&](const Node& written, Eigen::Vector3d& direction) {
    const std::string frame = frame_of_axis(written, scope.sdf_version);
    if (!frame.empty())
      direction = q_MJ.conjugate() * (scope.frames.find(frame, node).q * direction);
  };
  if (!free && axis) turn(*axis, joint.axis.axis);
  if (two) turn(node.required("axis2"), joint.axis2.axis);
  return joint;
}

namespace {

/// A joint by which a link turns relative to the reference body, and its sign about an axis.
struct HeldBy {
  const Joint* joint = nullptr;
  double sign = 1.0;
};

HeldBy find_joint(const std::string& link, const std::string& reference,
                  const Eigen::Vector3d& axis_M, const JointScope& scope, const Model& model) {
  for (const Joint& joint : model.joints) {
    if (!turns(joint.type)) continue;
    const bool holds = joint.child == link && joint.parent == reference;
    if (!holds && !(joint.child == reference && joint.parent == link)) continue;
    const Eigen::Quaterniond q_MJ = scope.X_ML.at(joint.child).q * joint.X_CJ.q;
    const double along = axis_M.dot(q_MJ * joint.axis.axis);
    return {&joint, (along < 0.0) == holds ? -1.0 : 1.0};
  }
  return {};
}

}  // namespace

void read_sdf_gearbox(const Node& node, const JointScope& scope, Log& log, Model& model) {
  const auto link = [&](const char* name) {
    return link_of(without_own_scope(node.required(name).required_text(), scope), scope);
  };
  const std::string parent = link("parent"), child = link("child");
  const std::string reference = link("gearbox_reference_body");
  for (const std::string& named : {parent, child, reference}) {
    if (scope.X_ML.count(named) == 0) throw Error(node.source(), unknown_link(named, scope.model));
  }
  const auto axis_M = [&](const char* name) -> Eigen::Vector3d {
    const auto axis = node.child(name);
    if (!axis) return scope.X_ML.at(child).q * Eigen::Vector3d::UnitZ();
    const std::string frame = frame_of_axis(*axis, scope.sdf_version);
    const Eigen::Quaterniond q_MF =
        frame.empty() ? scope.X_ML.at(child).q : scope.frames.find(frame, node).q;
    return q_MF * read_axis(*axis).axis;
  };
  const HeldBy first = find_joint(parent, reference, axis_M("axis"), scope, model);
  const HeldBy second = find_joint(child, reference, axis_M("axis2"), scope, model);
  if (!first.joint || !second.joint) {
    log.warn(node.source(),
             "found a gearbox whose links are not held on its reference body by revolute joints, "
             "expected two; they are not coupled");
    return;
  }
  Coupling coupling;
  coupling.leader = first.joint->name;
  coupling.follower = second.joint->name;
  coupling.multiplier = -node.number("gearbox_ratio", 1.0) * first.sign * second.sign;
  coupling.source = node.source();
  model.couplings.push_back(coupling);
}

}  // namespace ardee
