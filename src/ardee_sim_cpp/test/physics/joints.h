// SPDX-License-Identifier: MIT
#pragma once

#include "models.h"

namespace ardee::test {

/// Returns a rod's inertia about its end: the moment of a link that turns about a joint at the
/// link's origin, with its centre of mass there too, so that gravity has no lever.
inline Inertial wheel_inertial(double mass_kg, double moment_kg_m2) {
  Inertial inertial;
  inertial.mass_kg = mass_kg;
  inertial.inertia_kg_m2 = moment_kg_m2 * Eigen::Matrix3d::Identity();
  return inertial;
}

/// Returns one link on a joint to the world. The link's frame lies at `X_ML`, the joint's at the
/// link's origin.
inline std::shared_ptr<Model> jointed_model(JointType type, const Inertial& inertial,
                                            const JointAxis& axis, const Pose& X_ML = {}) {
  auto result = model(link("child", inertial));
  result->links[0].X_ML = X_ML;
  Joint joint;
  joint.name = "joint";
  joint.type = type;
  joint.parent = "world";
  joint.child = "child";
  joint.axis = axis;
  joint.axis2.axis = {0, 1, 0};
  result->joints.push_back(joint);
  return result;
}

inline JointAxis axis_along(const Eigen::Vector3d& direction) {
  JointAxis axis;
  axis.axis = direction;
  return axis;
}

inline PhysicsParams weightless(double step_s) {
  PhysicsParams result = params(step_s);
  result.gravity_m_per_s2.setZero();
  return result;
}

}  // namespace ardee::test
