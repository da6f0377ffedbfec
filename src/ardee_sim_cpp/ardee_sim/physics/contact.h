// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>

#include "ardee_sim/core/state_archive.h"

namespace ardee::physics {

/// A force (N) and a torque (N m) about a point that its owner names.
struct ForceTorque {
  Eigen::Vector3d force{0, 0, 0};
  Eigen::Vector3d torque{0, 0, 0};

  void serialize(StateArchive& state) { state(force, torque); }
};

/// A point at which two collisions touched in a step. All vectors have the world's axes.
struct Contact {
  std::string collision1;  // "model::link::collision", as Gazebo scopes names
  std::string collision2;
  Eigen::Vector3d position{0, 0, 0};
  Eigen::Vector3d normal{0, 0, 0};  // from the second into the first
  double depth_m = 0.0;
  /// Wrench on each collision over the step: about the centre of mass of its body, or for scenery,
  /// which has no body, about the collision's frame.
  ForceTorque on1;
  ForceTorque on2;

  void serialize(StateArchive& state) {
    state(collision1, collision2, position, normal, depth_m, on1, on2);
  }
};

}  // namespace ardee::physics
