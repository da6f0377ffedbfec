// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/description/world.h"
#include "ardee_sim/physics/body_states.h"
#include "ardee_sim/physics/joint_coupling.h"
#include "ardee_sim/physics/ode_types.h"

namespace ardee::physics {

/// Least constraint force mixing of any row, in s/kg. It keeps redundant rows from making the
/// direct system singular. Under 30 N it permits a slip of 0.03 um/s.
constexpr double kLeastCfm = 1e-9;

/// Island of models that touch one another.
struct Island {
  std::size_t rows = 0;  // an upper bound of its constraint rows
  std::size_t models = 0;
  std::vector<JointCoupling*> couplings;
  std::vector<dBodyID> bodies;  // in an order that does not depend on that of their creation
};

/// Solves one step, island by island. The direct solver costs no more than 50 iterations of the
/// iterative solver for the few dozen rows of a robot and its contacts, and leaves no error: a body
/// at rest stays at its place for any lever arm. It therefore solves small islands even where the
/// world asks for `quick`. Its time grows with the cube of the rows, so the iterative solver takes
/// the large islands, and those that the direct solver finds singular.
class Solver {
 public:
  explicit Solver(dWorldID world);
  ~Solver();
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  /// The iterations shuffle rows with a random number that ODE keeps for the whole process: this
  /// world has its own, lent to ODE for each step.
  void reset_random(std::uint64_t seed) { seed_ = static_cast<unsigned long>(seed); }
  void serialize(StateArchive& state) { state(seed_); }

  /// Throws Error if the engine runs out of memory, or the system cannot be solved at all.
  void step(const PhysicsParams& params, std::vector<Island> islands);
  /// Whether all of the last step was solved directly.
  bool was_direct() const { return was_direct_; }

 private:
  void step_plain(const PhysicsParams& params, const std::vector<Island>& islands);
  bool solve_directly(const PhysicsParams& params, const std::vector<dBodyID>& bodies);
  void iterate(const PhysicsParams& params, const Island& island);
  /// Empties the engine's list of work, which a fault leaves half done.
  void renew_threads();

  dWorldID world_;
  ThreadingHandle threads_;
  unsigned long seed_ = 0;
  bool was_direct_ = false;
  BodyStates saved_;
};

}  // namespace ardee::physics
