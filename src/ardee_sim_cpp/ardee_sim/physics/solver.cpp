// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/solver.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "ardee_sim/core/error.h"
#include "ardee_sim/physics/ode_library.h"

namespace ardee::physics {
namespace {

constexpr std::size_t kDirectRows = 160;

void disable(const Island& island) {
  for (dBodyID body : island.bodies) dBodyDisable(body);
}

/// Enables all bodies that joints connect to a body.
void enable_joined(dBodyID from) {
  std::vector<dBodyID> open{from};
  dBodyEnable(from);
  while (!open.empty()) {
    dBodyID body = open.back();
    open.pop_back();
    for (int i = 0; i < dBodyGetNumJoints(body); ++i) {
      dJointID joint = dBodyGetJoint(body, i);
      if (!dJointIsEnabled(joint)) continue;
      for (const int side : {0, 1}) {
        dBodyID other = dJointGetBody(joint, side);
        if (!other || dBodyIsEnabled(other)) continue;
        dBodyEnable(other);
        open.push_back(other);
      }
    }
  }
}

/// Steps an island by the engine. The engine gathers connected bodies from an enabled body on,
/// beginning with the one created last. Where several models touch, only one of the connected
/// bodies is therefore enabled, so that the order of rows does not depend on the order of creation.
void enable(const Island& island) {
  if (island.models == 1) {
    for (dBodyID body : island.bodies) dBodyEnable(body);
    return;
  }
  std::vector<dBodyID> first;
  for (auto body = island.bodies.rbegin(); body != island.bodies.rend(); ++body) {
    if (dBodyIsEnabled(*body)) continue;
    first.push_back(*body);
    enable_joined(*body);
  }
  disable(island);
  for (dBodyID body : first) dBodyEnable(body);
}

/// ODE refuses to free a list that still holds work, as it does after a fault.
void keep_for_ever(ThreadingHandle threads) {
  static std::mutex mutex;
  static auto* const kept = new std::vector<ThreadingHandle>;
  const std::lock_guard<std::mutex> lock(mutex);
  kept->push_back(std::move(threads));
}

}  // namespace

Solver::Solver(dWorldID world) : world_(world) { renew_threads(); }

Solver::~Solver() { dWorldSetStepThreadingImplementation(world_, nullptr, nullptr); }

void Solver::renew_threads() {
  ThreadingHandle fresh(dThreadingAllocateSelfThreadedImplementation());
  if (!fresh) throw Error("physics engine: out of memory");
  dWorldSetStepThreadingImplementation(world_, dThreadingImplementationGetFunctions(fresh.get()),
                                       fresh.get());
  std::swap(threads_, fresh);
  if (fresh) keep_for_ever(std::move(fresh));
}

bool Solver::solve_directly(const PhysicsParams& params, const std::vector<dBodyID>& bodies) {
  saved_.save(bodies);
  OdeLibrary::take_singular_warning();
  try {
    if (dWorldStep(world_, params.step_s) && !OdeLibrary::take_singular_warning()) return true;
  } catch (const EngineFault&) {
    renew_threads();
  }
  saved_.restore();
  return false;
}

void Solver::iterate(const PhysicsParams& params, const Island& island) {
  enable(island);
  static std::mutex ode_random;  // worlds may step in several threads
  const std::lock_guard<std::mutex> lock(ode_random);
  dRandSetSeed(seed_);
  int done = 0;
  try {
    done = dWorldQuickStep(world_, params.step_s);
  } catch (const EngineFault&) {
    renew_threads();
    throw;
  }
  seed_ = dRandGetSeed();
  if (!done) throw Error("physics engine: out of memory");
  disable(island);
}

void Solver::step(const PhysicsParams& params, std::vector<Island> islands) {
  dWorldSetCFM(world_, std::max(params.cfm, kLeastCfm));
  const auto first_coupled =
      std::stable_partition(islands.begin(), islands.end(),
                            [](const Island& island) { return island.couplings.empty(); });
  const std::vector<Island> coupled(first_coupled, islands.end());
  islands.erase(first_coupled, islands.end());
  for (const Island& island : coupled) disable(island);
  step_plain(params, islands);
  bool all_direct = was_direct_;
  for (const Island& island : coupled) {
    step_coupled(island.couplings, island.bodies, params.step_s,
                 [&] { step_plain(params, {island}); });
    all_direct = all_direct && was_direct_;
  }
  was_direct_ = all_direct;
}

void Solver::step_plain(const PhysicsParams& params, const std::vector<Island>& islands) {
  const bool all_direct = params.solver == PhysicsParams::Solver::kWorld;
  const auto is_direct = [all_direct](const Island& island) {
    return all_direct || island.rows <= kDirectRows;
  };
  std::vector<dBodyID> bodies;
  for (const Island& island : islands) {
    disable(island);
    if (is_direct(island)) bodies.insert(bodies.end(), island.bodies.begin(), island.bodies.end());
  }
  for (const Island& island : islands) {
    if (is_direct(island)) enable(island);
  }
  const bool solved = solve_directly(params, bodies);
  for (const Island& island : islands) {
    if (is_direct(island)) disable(island);
  }
  was_direct_ = solved;
  for (const Island& island : islands) {
    if (solved && is_direct(island)) continue;
    was_direct_ = false;
    iterate(params, island);
  }
}

}  // namespace ardee::physics
