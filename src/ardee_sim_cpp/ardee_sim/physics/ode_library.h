// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/error.h"

namespace ardee::physics {

/// A number that is none, met by ODE in the midst of its work: what it was doing is half done.
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

  /// ODE keeps collision data for each thread: called by a thread before it collides.
  static void prepare_thread();
  /// Whether ODE has complained, on this thread since the last call, that a system was too
  /// ill-conditioned to solve.
  static bool take_singular_warning();
};

}  // namespace ardee::physics
