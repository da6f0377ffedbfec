// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/sensor.h"

namespace ardee {

Sensor::Sensor(const std::string& name, const Mount& mount)
    : Device(name), mount_(mount), timer_(mount.rate_hz), stream_(stream_key(mount.seed, name)) {
  if (mount.rate_hz < 0.0) {
    throw Error("sensor '" + name + "': found an update rate below 0 Hz, expected 0 or more");
  }
}

void Sensor::after_step(TimeNs now_ns, ReadingSink& sink) {
  if (!timer_.due(now_ns) || !wanted()) return;
  // The frame's index counts unwanted frames too, so that noise does not depend on who listens.
  sample(now_ns, stream_.frame(timer_.count() - 1), sink);
}

void Sensor::reset(TimeNs now_ns) {
  timer_.reset();
  timer_.start_at(now_ns + 1);
}

}  // namespace ardee
