// SPDX-License-Identifier: MIT
#include "ardee_sim/core/time.h"

#include <cmath>

namespace ardee {

TimeNs nanoseconds(double time_s) { return std::llround(time_s * kNsPerSecond); }

TimeNs RateTimer::firing_time(std::uint64_t index) const {
  // Long double keeps whole nanoseconds over centuries, so the grid does not drift.
  return offset_ns_ +
         std::llroundl(static_cast<long double>(index) * 1e9L / static_cast<long double>(rate_hz_));
}

bool RateTimer::due(TimeNs now_ns) {
  if (rate_hz_ <= 0.0) {
    ++next_;
    return true;
  }
  if (now_ns < firing_time(next_)) return false;
  ++next_;
  if (now_ns >= firing_time(next_)) start_at(now_ns + 1);
  return true;
}

void RateTimer::start_at(TimeNs now_ns) {
  if (rate_hz_ <= 0.0) return;
  const long double passed =
      static_cast<long double>(now_ns - offset_ns_) * static_cast<long double>(rate_hz_) / 1e9L;
  next_ = passed <= 0.0L ? 0 : static_cast<std::uint64_t>(std::floor(passed));
  while (firing_time(next_) < now_ns) ++next_;
}

}  // namespace ardee
