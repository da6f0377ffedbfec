// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "ardee_sim/core/rng.h"
#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/core/time.h"
#include "ardee_sim/description/parameters.h"

namespace ardee::devices {

/// Parameters of the vibration of sensors on a robot that drives over clods.
struct VibrationParams {
  Eigen::Vector3d std_m_per_s2{0, 0, 0};  // at speed_m_per_s, proportional to the speed
  double speed_m_per_s = 1.0;
  // Nominal: clods and ridges of 0.05 m to 0.3 m under wheels at 1 m/s.
  double low_hz = 3.0;
  double high_hz = 20.0;
};

/// <vibrationStdAccel> (x y z), <vibrationSpeed>, <vibrationBand> (two frequencies); returns none
/// if the first is absent or zero.
std::optional<VibrationParams> read_vibration(Parameters& parameters);

/// Gaussian noise in a band of frequencies: white noise through Butterworth filters of second
/// order, a high-pass at `low_hz` and a low-pass at `high_hz`, of unit variance.
class BandNoise {
 public:
  BandNoise(double low_hz, double high_hz) : low_hz_(low_hz), high_hz_(high_hz) {}

  void reset();
  void serialize(StateArchive& state) { state(dt_s_, gain_, high_pass_, low_pass_); }
  /// Returns the next sample, made from one sample of white noise.
  double next(double white, double dt_s);

 private:
  /// A filter of second order, direct form II transposed.
  struct Biquad {
    std::array<double, 3> b{};
    std::array<double, 2> a{};
    std::array<double, 2> state{};

    double next(double input);
    void serialize(StateArchive& archive) { archive(b, a, state); }
  };
  void design(double dt_s);

  double low_hz_;
  double high_hz_;
  double dt_s_ = 0.0;  // of the present filters
  double gain_ = 0.0;
  Biquad high_pass_;
  Biquad low_pass_;
};

/// Vibration in the sensor's axes, step by step.
class Vibration {
 public:
  Vibration(const VibrationParams& params, std::uint64_t key);

  void reset(TimeNs now_ns, std::uint64_t noise_seed = 0);
  void serialize(StateArchive& state) { state(random_, unit_, noise_); }
  void step(double dt_s);
  /// Acceleration in m/s^2 at a speed.
  Eigen::Vector3d at_speed(double speed_m_per_s) const;

 private:
  VibrationParams params_;
  std::uint64_t key_;
  Rng random_;
  std::array<BandNoise, 3> noise_;
  Eigen::Vector3d unit_{0, 0, 0};
};

}  // namespace ardee::devices
