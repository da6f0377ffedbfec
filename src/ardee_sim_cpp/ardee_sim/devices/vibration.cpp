// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/vibration.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace ardee::devices {
namespace {

constexpr double kMostHz = 1e5;
constexpr double kBelowNyquist = 0.45;  // greatest upper corner, as a share of the sampling rate

}  // namespace

std::optional<VibrationParams> read_vibration(Parameters& parameters) {
  VibrationParams params;
  params.std_m_per_s2 = parameters.vector3("vibrationStdAccel", params.std_m_per_s2);
  if (params.std_m_per_s2.minCoeff() < 0.0) {
    throw parameters.error("vibrationStdAccel", "expected no number below zero");
  }
  params.speed_m_per_s = parameters.number("vibrationSpeed", params.speed_m_per_s, 1e-3, 1e3);
  if (const Element* band = parameters.block("vibrationBand")) {
    std::istringstream stream(band->text);
    std::string low, high, rest;
    if (!(stream >> low >> high) || (stream >> rest)) {
      throw parameters.error("vibrationBand", "expected two frequencies in Hz");
    }
    params.low_hz = parse_number(low, band->source);
    params.high_hz = parse_number(high, band->source);
    const bool is_band =
        params.low_hz > 0.0 && params.low_hz < params.high_hz && params.high_hz <= kMostHz;
    if (!is_band) throw parameters.error("vibrationBand", "expected 0 < low < high, in Hz");
  }
  if (params.std_m_per_s2.isZero()) return std::nullopt;
  return params;
}

double BandNoise::Biquad::next(double input) {
  const double output = b[0] * input + state[0];
  state[0] = b[1] * input - a[0] * output + state[1];
  state[1] = b[2] * input - a[1] * output;
  return output;
}

void BandNoise::reset() {
  high_pass_.state.fill(0.0);
  low_pass_.state.fill(0.0);
}

void BandNoise::design(double dt_s) {
  // Bilinear transform of the Butterworth prototype, Q = 1/sqrt(2): R. Bristow-Johnson, Cookbook
  // formulae for audio equalizer biquad filter coefficients.
  const auto filter = [dt_s](double corner_hz, bool passes_high) {
    const double turn = 2.0 * M_PI * std::min(corner_hz * dt_s, kBelowNyquist);
    const double alpha = std::sin(turn) * M_SQRT1_2;
    const double cosine = std::cos(turn), a0 = 1.0 + alpha;
    const double side = (passes_high ? 1.0 + cosine : 1.0 - cosine) / (2.0 * a0);
    Biquad made;
    made.b = {side, passes_high ? -2.0 * side : 2.0 * side, side};
    made.a = {-2.0 * cosine / a0, (1.0 - alpha) / a0};
    return made;
  };
  dt_s_ = dt_s;
  high_pass_ = filter(low_hz_, true);
  low_pass_ = filter(high_hz_, false);
  // The variance of filtered white noise is the energy of the impulse response, which has decayed
  // after some periods of the lower corner.
  constexpr double kPeriods = 10.0, kMostSamples = 1e6;
  const auto samples =
      static_cast<int>(std::min(kPeriods / (low_hz_ * dt_s) + 100.0, kMostSamples));
  double energy = 0.0;
  for (int i = 0; i < samples; ++i) {
    const double response = low_pass_.next(high_pass_.next(i == 0 ? 1.0 : 0.0));
    energy += response * response;
  }
  gain_ = energy > 0.0 ? 1.0 / std::sqrt(energy) : 0.0;
  reset();
}

double BandNoise::next(double white, double dt_s) {
  if (dt_s != dt_s_) design(dt_s);
  return gain_ * low_pass_.next(high_pass_.next(white));
}

Vibration::Vibration(const VibrationParams& params, std::uint64_t key)
    : params_(params),
      key_(key),
      random_(key),
      noise_{BandNoise(params.low_hz, params.high_hz), BandNoise(params.low_hz, params.high_hz),
             BandNoise(params.low_hz, params.high_hz)} {}

void Vibration::reset(TimeNs now_ns, std::uint64_t noise_seed) {
  random_ = Rng(reseeded(key_, noise_seed), now_ns);
  unit_.setZero();
  for (BandNoise& each : noise_) each.reset();
}

void Vibration::step(double dt_s) {
  for (int axis = 0; axis < 3; ++axis) {
    unit_[axis] = noise_[static_cast<std::size_t>(axis)].next(random_.normal(), dt_s);
  }
}

Eigen::Vector3d Vibration::at_speed(double speed_m_per_s) const {
  return speed_m_per_s / params_.speed_m_per_s * unit_.cwiseProduct(params_.std_m_per_s2);
}

}  // namespace ardee::devices
