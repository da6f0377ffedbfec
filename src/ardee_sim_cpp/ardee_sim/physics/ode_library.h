// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/error.h"

namespace ardee::physics {

/// Thrown when ODE meets a NaN in the middle of its work, which is then half done.
class EngineFault : public Error {
 public:
  using Error::Error;
};

/// Holds ODE open while it lives: ODE itself is initialised by the first holder in the process and
/// closed by the last.
class OdeLibrary {
 public:
  OdeLibrary();
  ~OdeLibrary();
  OdeLibrary(const OdeLibrary&) = delete;
  OdeLibrary& operator=(const OdeLibrary&) = delete;

  /// Allocates ODE's collision data of this thread. Each thread calls it before it collides shapes.
  static void prepare_thread();
  /// Whether ODE has warned, on this thread since the last call, of a system too ill-conditioned to
  /// solve.
  static bool take_singular_warning();
};

}  // namespace ardee::physics
