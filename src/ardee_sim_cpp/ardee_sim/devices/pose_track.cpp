// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/pose_track.h"

#include <algorithm>

namespace ardee::devices {

void PoseTrack::add(TimeNs time_ns, const Pose& X_WS) {
  if (!track_.empty() && track_.back().time_ns == time_ns) track_.pop_back();
  track_.push_back({time_ns, X_WS});
  // Interpolation needs the last pose before the kept duration.
  while (track_.size() > 2 && track_[1].time_ns <= time_ns - duration_ns_) track_.pop_front();
}

Pose PoseTrack::at(double time_ns) const {
  const auto after = std::lower_bound(
      track_.begin(), track_.end(), time_ns,
      [](const Stamped& each, double time) { return static_cast<double>(each.time_ns) < time; });
  if (after == track_.end()) return track_.back().X_WS;
  if (after == track_.begin()) return track_.front().X_WS;
  const Stamped& before = *std::prev(after);
  const double share = (time_ns - static_cast<double>(before.time_ns)) /
                       static_cast<double>(after->time_ns - before.time_ns);
  return {before.X_WS.p + share * (after->X_WS.p - before.X_WS.p),
          before.X_WS.q.slerp(share, after->X_WS.q).normalized()};
}

}  // namespace ardee::devices
