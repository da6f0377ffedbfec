// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>

#include "ardee_sim/core/rng.h"
#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/core/time.h"
#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/device.h"

namespace ardee::devices {

/// Law by which a drift moves in a time dt. kHector: as hector_gazebo's SensorModel does, d <-
/// exp(-f dt) d + dt N(0, sqrt(2 f) drift), whose standard deviation settles at about drift
/// sqrt(dt) from any initial value. kExact: the Gauss-Markov process itself, of standard deviation
/// `drift` at any rate.
enum class NoiseMode { kHector, kExact };

/// The plugin's <noiseMode>: hector (default) or exact.
NoiseMode read_noise_mode(Parameters& parameters);

/// Errors of hector_gazebo's sensors, axis by axis, in the unit of the measured quantity.
struct SensorErrors {
  Eigen::Vector3d offset{0, 0, 0};
  Eigen::Vector3d drift{0, 0, 0};  // standard deviation
  Eigen::Vector3d drift_frequency_hz =
      Eigen::Vector3d::Constant(1.0 / 3600.0);  // 1 / time constant of the drift
  Eigen::Vector3d gaussian_noise{0, 0, 0};      // standard deviation, drawn at each sample
  Eigen::Vector3d scale_error{1, 1, 1};
  NoiseMode mode = NoiseMode::kHector;

  void serialize(StateArchive& state) {
    state(offset, drift, drift_frequency_hz, gaussian_noise, scale_error, mode);
  }
};

/// The keys offset, drift, driftFrequency, gaussianNoise, scaleError; with a prefix ("accel"),
/// accelOffset and so on. A value is one number for all axes, or three numbers. A negative drift,
/// frequency or noise is an Error.
SensorErrors read_sensor_errors(Parameters& parameters, const std::string& prefix, NoiseMode mode);

/// Returns a requested bias. Throws Error if it is not finite or beyond the range of any sensor.
const Eigen::Vector3d& checked_bias(const Eigen::Vector3d& bias);

/// Corrupts a value of one or three axes: value * scale_error + offset + drift + noise. The errors
/// are a pure function of the key, the time of the reset and the samples since; a model of one axis
/// uses the first axis.
class SensorModel {
 public:
  /// `key` is that of its random stream, see stream_key(); `axes` is 1 or 3.
  SensorModel(const SensorErrors& errors, int axes, std::uint64_t key);

  /// Draws the drift anew, by the errors as they were before any tuning; each time of reset, and
  /// each noise seed, has different errors.
  void reset(TimeNs now_ns, std::uint64_t noise_seed = 0);
  void serialize(StateArchive& state) { state(errors_, random_, drift_); }
  /// Sets the drift, which continues from there.
  void set_drift(const Eigen::Vector3d& drift) { drift_ = drift; }
  const Eigen::Vector3d& drift() const { return drift_; }
  /// Offset and drift: the error without the noise.
  Eigen::Vector3d bias() const { return errors_.offset + drift_; }

  /// Value that the sensor reports, dt after the previous sample.
  Eigen::Vector3d corrupt(const Eigen::Vector3d& value, double dt_s);
  double corrupt(double value, double dt_s);
  /// Moves the drift on and draws the noise: the next error for all axes.
  Eigen::Vector3d next_error(double dt_s);

  const SensorErrors& errors() const { return errors_; }
  /// Variance by axis of the noise (gaussian_noise^2), and of noise and drift.
  Eigen::Vector3d noise_variance() const { return errors_.gaussian_noise.cwiseAbs2(); }
  Eigen::Vector3d variance() const { return noise_variance() + errors_.drift.cwiseAbs2(); }

  /// hector_gazebo_plugins/SensorModel as a dynamic_reconfigure server of that name: setting a
  /// number sets it for all axes, reading gives their mean. Valid as long as this model stays at
  /// its address.
  ParameterGroup tuning(const std::string& name);

 private:
  double next_drift(int axis, double dt_s);

  const SensorErrors initial_errors_;
  SensorErrors errors_;
  int axes_;
  std::uint64_t key_;
  Rng random_;
  Eigen::Vector3d drift_{0, 0, 0};
};

}  // namespace ardee::devices
