// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "ardee_sim/core/limits.h"
#include "ardee_sim/devices/gps_regions.h"

namespace ardee::devices {

GpsNoise combined(const GpsNoise& one, const GpsNoise& other) {
  GpsNoise both;
  both.mean_factor = one.mean_factor * other.mean_factor;
  both.variance_factor = one.variance_factor * other.variance_factor;
  both.correlated_std_m = std::hypot(one.correlated_std_m, other.correlated_std_m);
  both.loss_rate_hz = one.loss_rate_hz + other.loss_rate_hz;
  both.loss_duration_s = std::max(one.loss_duration_s, other.loss_duration_s);
  return both;
}

void NoiseBands::add(const Element& element, Log& log) {
  constexpr double kMostStd_m = 1e4;
  Parameters parameters(element);
  for (const char* key : {"r1", "r2", "mean", "variance"}) parameters.required_text(key);
  Band band;
  band.low = parameters.number("r1", 0.0);
  band.high = parameters.number("r2", 0.0);
  if (band.high == -1.0) band.high = std::numeric_limits<double>::infinity();
  if (band.high <= band.low) throw parameters.error("r2", "expected more than <r1>, or -1");
  band.noise.mean_factor =
      parameters.number("mean", 1.0, -limits::kMostFactor, limits::kMostFactor);
  band.noise.variance_factor = parameters.number("variance", 1.0, 0.0, limits::kMostFactor);
  band.noise.correlated_std_m = parameters.number("correlated_std", 0.0, 0.0, kMostStd_m);
  band.noise.loss_rate_hz = parameters.number("fix_loss_rate", 0.0, 0.0, limits::kMostRate_hz);
  band.noise.loss_duration_s =
      parameters.number("fix_loss_duration", 0.0, 0.0, limits::kLongestTime_s);
  if (band.noise.loss_rate_hz > 0.0 && band.noise.loss_duration_s <= 0.0) {
    throw parameters.error("fix_loss_duration", "expected more than 0 s with a <fix_loss_rate>");
  }
  parameters.finish(log);
  bands_.push_back(band);
}

const GpsNoise* NoiseBands::find(double value) const {
  for (const Band& band : bands_) {
    if (value >= band.low && value < band.high) return &band.noise;
  }
  return nullptr;
}

GpsNoise PeriodicNoise::at(TimeNs now_ns, const CounterRng& stream) const {
  const CounterRng draws =
      stream.frame(static_cast<std::uint64_t>(std::floor(seconds(now_ns) / period_s)));
  GpsNoise noise;
  noise.mean_factor = mean_mean + std::sqrt(mean_variance) * draws.normal(0);
  noise.variance_factor =
      std::max(0.0, variance_mean + std::sqrt(variance_variance) * draws.normal(1));
  return noise;
}

bool GpsRegion::contains(const Eigen::Vector3d& point_W) const {
  const Eigen::Vector3d inside = pose.inverse() * point_W;
  return (inside.cwiseAbs().array() <= 0.5 * size_m.array()).all();
}

}  // namespace ardee::devices
