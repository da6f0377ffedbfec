// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/sensor_model.h"

#include <cctype>
#include <cmath>
#include <stdexcept>

namespace ardee::devices {
namespace {

using Eigen::Vector3d;

/// "gaussianNoise" below the prefix "accel" is "accelGaussianNoise".
std::string key_of(const std::string& prefix, std::string key) {
  if (prefix.empty()) return key;
  key[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(key[0])));
  return prefix + key;
}

/// One number for all axes, or three.
Vector3d read_axes(Parameters& parameters, const std::string& key, const Vector3d& fallback) {
  const Element* given = parameters.block(key);
  if (!given) return fallback;
  constexpr const char* kSpace = " \t\r\n";
  const std::size_t gap = given->text.find_first_of(kSpace, given->text.find_first_not_of(kSpace));
  const bool is_one =
      gap == std::string::npos || given->text.find_first_not_of(kSpace, gap) == std::string::npos;
  return is_one ? Vector3d::Constant(parse_number(given->text, given->source))
                : parse_vector3(given->text, given->source);
}

Vector3d read_positive_axes(Parameters& parameters, const std::string& key,
                            const Vector3d& fallback) {
  const Vector3d value = read_axes(parameters, key, fallback);
  if (value.minCoeff() < 0.0) throw parameters.error(key, "expected no number below zero");
  return value;
}

}  // namespace

NoiseMode read_noise_mode(Parameters& parameters) {
  const std::string mode = parameters.text("noiseMode", "hector");
  if (mode == "hector") return NoiseMode::kHector;
  if (mode == "exact") return NoiseMode::kExact;
  throw parameters.error("noiseMode", "expected hector or exact");
}

SensorErrors read_sensor_errors(Parameters& parameters, const std::string& prefix, NoiseMode mode) {
  SensorErrors errors;
  const auto key = [&prefix](const char* name) { return key_of(prefix, name); };
  errors.offset = read_axes(parameters, key("offset"), errors.offset);
  errors.drift = read_positive_axes(parameters, key("drift"), errors.drift);
  errors.drift_frequency_hz =
      read_positive_axes(parameters, key("driftFrequency"), errors.drift_frequency_hz);
  errors.gaussian_noise =
      read_positive_axes(parameters, key("gaussianNoise"), errors.gaussian_noise);
  errors.scale_error = read_axes(parameters, key("scaleError"), errors.scale_error);
  errors.mode = mode;
  return errors;
}

const Vector3d& checked_bias(const Vector3d& bias) {
  constexpr double kMost = 1e6;
  if (bias.allFinite() && bias.cwiseAbs().maxCoeff() <= kMost) return bias;
  throw Error("found a bias that is not finite or out of range, expected three numbers up to 1e6");
}

SensorModel::SensorModel(const SensorErrors& errors, int axes, std::uint64_t key)
    : initial_errors_(errors), errors_(errors), axes_(axes), key_(key), random_(key) {
  if (axes != 1 && axes != 3) throw std::logic_error("a sensor model has one axis or three");
  reset(0);
}

void SensorModel::reset(TimeNs now_ns, std::uint64_t noise_seed) {
  errors_ = initial_errors_;
  random_ = Rng(reseeded(key_, noise_seed), now_ns);
  drift_.setZero();
  for (int axis = 0; axis < axes_; ++axis) drift_[axis] = errors_.drift[axis] * random_.normal();
}

double SensorModel::next_drift(int axis, double dt_s) {
  const double frequency = errors_.drift_frequency_hz[axis];
  const double kept = std::exp(-dt_s * frequency) * drift_[axis];
  if (errors_.mode == NoiseMode::kHector) {
    return kept + dt_s * std::sqrt(2.0 * frequency) * errors_.drift[axis] * random_.normal();
  }
  // -expm1(-x) = 1 - exp(-x), without cancellation for a slow drift.
  const double std = errors_.drift[axis] * std::sqrt(-std::expm1(-2.0 * frequency * dt_s));
  return kept + std * random_.normal();
}

Vector3d SensorModel::next_error(double dt_s) {
  Vector3d error = Vector3d::Zero();
  for (int axis = 0; axis < axes_; ++axis) {
    drift_[axis] = next_drift(axis, dt_s);
    error[axis] =
        errors_.offset[axis] + drift_[axis] + errors_.gaussian_noise[axis] * random_.normal();
  }
  return error;
}

Vector3d SensorModel::corrupt(const Vector3d& value, double dt_s) {
  return value.cwiseProduct(errors_.scale_error) + next_error(dt_s);
}

double SensorModel::corrupt(double value, double dt_s) {
  return value * errors_.scale_error.x() + next_error(dt_s).x();
}

ParameterGroup SensorModel::tuning(const std::string& name) {
  // Names, bounds and words of hector_gazebo_plugins' SensorModel.cfg.
  const auto tunable = [this](const char* key, const char* about, double low, double high,
                              Vector3d SensorErrors::*member) {
    TunableParameter made{key, about, TunableParameter::Type::kDouble, low, high, 0.0, {}, {}};
    made.get = [this, member] { return (errors_.*member).head(axes_).mean(); };
    made.set = [this, member](double value) { (errors_.*member).setConstant(value); };
    made.initial = made.get();
    return made;
  };
  return {
      name,
      {tunable("gaussian_noise", "Standard deviation of the additive white Gaussian noise", 0.0,
               10.0, &SensorErrors::gaussian_noise),
       tunable("offset", "Zero-offset of the published sensor signal", -10.0, 10.0,
               &SensorErrors::offset),
       tunable("drift", "Standard deviation of the sensor drift", 0.0, 10.0, &SensorErrors::drift),
       tunable("drift_frequency", "Reciprocal of the time constant of the first-order drift", 0.0,
               1.0, &SensorErrors::drift_frequency_hz),
       tunable("scale_error", "Scale error", 0.0, 2.0, &SensorErrors::scale_error)}};
}

}  // namespace ardee::devices
