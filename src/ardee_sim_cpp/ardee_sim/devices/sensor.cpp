// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/sensor.h"

#include <algorithm>

#include "ardee_sim/core/limits.h"

namespace ardee::devices {

Sensor::Sensor(const std::string& name, const Mount& mount)
    : Device(name),
      mount_(mount),
      timer_(mount.rate_hz, mount.offset_ns),
      stream_(stream_key(mount.seed, name)) {
  if (mount.rate_hz < 0.0) {
    throw Error("sensor '" + name + "': found an update rate below 0 Hz, expected 0 or more");
  }
}

void Sensor::after_step(TimeNs now_ns, ReadingSink& sink) {
  follow(now_ns);
  if (!timer_.due(now_ns) || !wanted()) return;
  elapsed_s_ = seconds(now_ns - last_ns_);
  last_ns_ = now_ns;
  // The frame's index counts unwanted frames too, so that noise does not depend on subscribers.
  sample(now_ns, stream_.frame(timer_.count() - 1), sink);
}

void Sensor::reset(TimeNs now_ns) {
  timer_.start_at(now_ns + 1);
  stream_ = CounterRng(reseeded(stream_key(mount_.seed, name()), noise_seed()));
  last_ns_ = now_ns;
}

Twist Sensor::twist() const {
  const Pose X_WL = mount_.robot.link_pose(mount_.link);
  Twist twist_W = mount_.robot.link_twist(mount_.link);
  twist_W.linear += twist_W.angular.cross(X_WL.q * mount_.X_LS.p);
  return twist_W;
}

double slower_rate_hz(double one_hz, double other_hz) {
  if (one_hz <= 0.0 || other_hz <= 0.0) return std::max(one_hz, other_hz);
  return std::min(one_hz, other_hz);
}

double read_update_rate_hz(Parameters& parameters, double fallback_hz) {
  constexpr double kMost_hz = limits::kMostRate_hz;
  return std::max(0.0, parameters.number("updateRate", fallback_hz, -kMost_hz, kMost_hz));
}

void read_update_times(Parameters& parameters, double default_rate_hz, Sensor::Mount& mount) {
  mount.rate_hz = read_update_rate_hz(parameters, default_rate_hz);
  const double period_s = parameters.number("updatePeriod", 0.0, 0.0, limits::kLongestTime_s);
  if (period_s > 0.0) mount.rate_hz = 1.0 / period_s;
  mount.offset_ns =
      nanoseconds(parameters.number("updateOffset", 0.0, 0.0, limits::kLongestTime_s));
}

}  // namespace ardee::devices
