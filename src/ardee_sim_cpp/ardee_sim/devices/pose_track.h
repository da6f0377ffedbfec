// SPDX-License-Identifier: MIT
#pragma once

#include <deque>

#include "ardee_sim/core/pose.h"
#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/core/time.h"

namespace ardee::devices {

/// Recent poses of an object, step by step.
class PoseTrack {
 public:
  /// Remembers poses for `duration_ns`.
  explicit PoseTrack(TimeNs duration_ns) : duration_ns_(duration_ns) {}

  /// Times must not decrease; a pose at the time of the last one replaces it.
  void add(TimeNs time_ns, const Pose& X_WS);
  void clear() { track_.clear(); }
  void serialize(StateArchive& state) { state(track_); }
  /// Pose at a time, interpolated along a line and by the shortest turn; constant before the first
  /// pose and after the last one. At least one pose is required.
  Pose at(double time_ns) const;

 private:
  struct Stamped {
    TimeNs time_ns;
    Pose X_WS;
    void serialize(StateArchive& state) { state(time_ns, X_WS); }
  };

  TimeNs duration_ns_;
  std::deque<Stamped> track_;
};

}  // namespace ardee::devices
