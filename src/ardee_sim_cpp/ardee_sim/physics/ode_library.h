// SPDX-License-Identifier: MIT
#pragma once

namespace ardee::physics {

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
  static bool take_complaint();
};

}  // namespace ardee::physics
