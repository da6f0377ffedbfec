// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/solver.h"

#include <algorithm>

#include "ardee_sim/core/error.h"
#include "ardee_sim/physics/ode_library.h"

namespace ardee::physics {
namespace {

constexpr std::size_t kDirectRows = 160;

void copy(const dReal* from, int count, dReal* to) { std::copy(from, from + count, to); }

}  // namespace

void Solver::save(const std::vector<dBodyID>& bodies) {
  saved_.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    BodyState& state = saved_[i];
    copy(dBodyGetPosition(bodies[i]), 3, state.position);
    copy(dBodyGetQuaternion(bodies[i]), 4, state.rotation);
    copy(dBodyGetLinearVel(bodies[i]), 3, state.linear);
    copy(dBodyGetAngularVel(bodies[i]), 3, state.angular);
    copy(dBodyGetForce(bodies[i]), 3, state.force);
    copy(dBodyGetTorque(bodies[i]), 3, state.torque);
  }
}

void Solver::restore(const std::vector<dBodyID>& bodies) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const BodyState& state = saved_[i];
    dBodySetPosition(bodies[i], state.position[0], state.position[1], state.position[2]);
    dBodySetQuaternion(bodies[i], state.rotation);
    dBodySetLinearVel(bodies[i], state.linear[0], state.linear[1], state.linear[2]);
    dBodySetAngularVel(bodies[i], state.angular[0], state.angular[1], state.angular[2]);
    dBodySetForce(bodies[i], state.force[0], state.force[1], state.force[2]);
    dBodySetTorque(bodies[i], state.torque[0], state.torque[1], state.torque[2]);
  }
}

bool Solver::solve_directly(const PhysicsParams& params, const std::vector<dBodyID>& bodies) {
  save(bodies);
  OdeLibrary::take_complaint();
  if (dWorldStep(world_, params.step_s) && !OdeLibrary::take_complaint()) return true;
  restore(bodies);
  return false;
}

void Solver::iterate(const PhysicsParams& params) {
  dRandSetSeed(seed_);
  const int done = dWorldQuickStep(world_, params.step_s);
  seed_ = dRandGetSeed();
  if (!done) throw Error("physics engine: out of memory");
}

void Solver::step(const PhysicsParams& params, std::size_t rows,
                  const std::vector<dBodyID>& bodies) {
  dWorldSetCFM(world_, std::max(params.cfm, kLeastCfm));
  const bool wants_direct = rows <= kDirectRows || params.solver == PhysicsParams::Solver::kWorld;
  was_direct_ = wants_direct && solve_directly(params, bodies);
  if (!was_direct_) iterate(params);
}

}  // namespace ardee::physics
