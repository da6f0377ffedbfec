// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ardee_sim/description/world.h"
#include "ardee_sim/physics/ode_types.h"

namespace ardee::physics {

/// Solves one step. The direct solver costs no more than 50 iterations of the other for the few dozen rows of a robot and
/// its contacts, and leaves no error behind: what rests stays where it is, whatever the lever arms. So it takes small
/// systems even where the world asks for `quick`; its time grows with the cube of the rows, so it leaves the large ones. A
/// system that is singular to it is solved again by iterations.
class Solver {
 public:
  explicit Solver(dWorldID world) : world_(world) {}

  /// `rows`: an upper bound of all constraint rows. Throws Error if the engine runs out of memory.
  void step(const PhysicsParams& params, std::size_t rows, const std::vector<dBodyID>& bodies);

 private:
  /// What a step changes of a body.
  struct BodyState {
    dVector3 position, linear, angular, force, torque;
    dQuaternion rotation;
  };

  void save(const std::vector<dBodyID>& bodies);
  void restore(const std::vector<dBodyID>& bodies) const;

  dWorldID world_;
  std::vector<BodyState> saved_;
};

}  // namespace ardee::physics
