// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "ardee_sim/physics/ode_types.h"

namespace ardee::physics {

/// State of bodies that a step changes, saved to undo the step.
class BodyStates {
 public:
  void save(const std::vector<dBodyID>& bodies) {
    saved_.resize(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      State& state = saved_[i];
      state.body = bodies[i];
      std::copy_n(dBodyGetPosition(bodies[i]), 3, state.position);
      std::copy_n(dBodyGetQuaternion(bodies[i]), 4, state.rotation);
      std::copy_n(dBodyGetLinearVel(bodies[i]), 3, state.linear);
      std::copy_n(dBodyGetAngularVel(bodies[i]), 3, state.angular);
      std::copy_n(dBodyGetForce(bodies[i]), 3, state.force);
      std::copy_n(dBodyGetTorque(bodies[i]), 3, state.torque);
    }
  }

  void restore() const {
    for (const State& state : saved_) {
      dBodySetPosition(state.body, state.position[0], state.position[1], state.position[2]);
      dBodySetQuaternion(state.body, state.rotation);
      dBodySetLinearVel(state.body, state.linear[0], state.linear[1], state.linear[2]);
      dBodySetAngularVel(state.body, state.angular[0], state.angular[1], state.angular[2]);
      dBodySetForce(state.body, state.force[0], state.force[1], state.force[2]);
      dBodySetTorque(state.body, state.torque[0], state.torque[1], state.torque[2]);
    }
  }

 private:
  struct State {
    dBodyID body;
    dVector3 position, linear, angular, force, torque;
    dQuaternion rotation;
  };
  std::vector<State> saved_;
};

}  // namespace ardee::physics
