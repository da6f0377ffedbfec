// SPDX-License-Identifier: MIT
#include "ardee_sim/core/time.h"

#include <cmath>
#include <limits>

namespace ardee {
namespace {

/// Long double keeps whole nanoseconds over centuries, so that the grid of firing times does not
/// drift.
TimeNs round_within_range(long double time_ns) {
  constexpr TimeNs kLast_ns = std::numeric_limits<TimeNs>::max();
  constexpr auto kEnd_ns = static_cast<long double>(kLast_ns);
  if (time_ns >= kEnd_ns) return kLast_ns;
  if (time_ns <= -kEnd_ns) return -kLast_ns;
  return std::llroundl(time_ns);
}

}  // namespace

TimeNs nanoseconds(double time_s) {
  return round_within_range(static_cast<long double>(time_s * kNsPerSecond));
}

RateTimer::RateTimer(double rate_hz, TimeNs offset_ns)
    : rate_hz_(rate_hz <= kNsPerSecond ? rate_hz : 0.0), offset_ns_(offset_ns) {}

TimeNs RateTimer::firing_time(std::uint64_t index) const {
  return round_within_range(static_cast<long double>(offset_ns_) +
                            static_cast<long double>(index) * 1e9L /
                                static_cast<long double>(rate_hz_));
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
  if (rate_hz_ <= 0.0) {
    next_ = now_ns > 0 ? static_cast<std::uint64_t>(now_ns - 1) : 0;
    return;
  }
  const long double passed =
      static_cast<long double>(now_ns - offset_ns_) * static_cast<long double>(rate_hz_) / 1e9L;
  next_ = passed <= 0.0L ? 0 : static_cast<std::uint64_t>(std::floor(passed));
  while (firing_time(next_) < now_ns) ++next_;
}

}  // namespace ardee
