// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "ardee_sim/physics/ode_types.h"

namespace ardee::physics {

/// State of a body that a step changes.
struct BodyState {
  explicit BodyState(dBodyID body) {
    std::copy_n(dBodyGetPosition(body), 3, position);
    std::copy_n(dBodyGetQuaternion(body), 4, rotation);
    std::copy_n(dBodyGetLinearVel(body), 3, linear);
    std::copy_n(dBodyGetAngularVel(body), 3, angular);
    std::copy_n(dBodyGetForce(body), 3, force);
    std::copy_n(dBodyGetTorque(body), 3, torque);
  }

  /// Gives the body this state, bit by bit.
  void restore(dBodyID body) const {
    dBodySetPosition(body, position[0], position[1], position[2]);
    dBodySetQuaternion(body, rotation);
    // ODE has normalised the rotation once more, which may change its last bits.
    std::copy_n(rotation, 4, const_cast<dReal*>(dBodyGetQuaternion(body)));
    dRfromQ(const_cast<dReal*>(dBodyGetRotation(body)), rotation);
    dBodySetLinearVel(body, linear[0], linear[1], linear[2]);
    dBodySetAngularVel(body, angular[0], angular[1], angular[2]);
    dBodySetForce(body, force[0], force[1], force[2]);
    dBodySetTorque(body, torque[0], torque[1], torque[2]);
  }

  dVector3 position{}, linear{}, angular{}, force{}, torque{};
  dQuaternion rotation{};
};

/// States of bodies, saved to undo a step.
class BodyStates {
 public:
  void save(const std::vector<dBodyID>& bodies) {
    bodies_ = bodies;
    states_.clear();
    for (dBodyID body : bodies) states_.emplace_back(body);
  }

  void restore() const {
    for (std::size_t i = 0; i < bodies_.size(); ++i) states_[i].restore(bodies_[i]);
  }

 private:
  std::vector<dBodyID> bodies_;
  std::vector<BodyState> states_;
};

}  // namespace ardee::physics
