// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/sdf_imu_noise.h"

#include <cmath>

#include "ardee_sim/devices/sdf_noise.h"

namespace ardee::devices {
namespace {

/// One axis' errors from the element that holds <mean>, <stddev> and so on.
void read_axis(const Element& noise, int axis, Rng& random, SdfImuNoise::Axes& axes) {
  SensorErrors& errors = axes.errors;
  const SdfNoise common = read_sdf_noise(noise, true);
  Parameters parameters(noise);
  const double bias_mean = parameters.number("bias_mean", 0.0);
  const double bias_std = parameters.number("bias_stddev", 0.0, 0.0);
  const double bias_density = parameters.number("dynamic_bias_stddev", 0.0, 0.0);
  const double bias_time_s = parameters.number("dynamic_bias_correlation_time", 0.0, 0.0);
  const double drawn = bias_mean + bias_std * random.normal();
  const double bias = random.uniform() < 0.5 ? -drawn : drawn;
  if (common.is_none) return;
  if (common.precision > 0.0) axes.precision[axis] = common.precision;
  errors.offset[axis] = common.mean + bias;
  errors.gaussian_noise[axis] = common.std;
  if (bias_density <= 0.0 || bias_time_s <= 0.0) return;
  errors.drift[axis] = bias_density * std::sqrt(bias_time_s / 2.0);
  errors.drift_frequency_hz[axis] = 1.0 / bias_time_s;
}

void read_axes(const Element* vector, Rng& random, SdfImuNoise::Axes& axes) {
  static constexpr const char* kAxes[] = {"x", "y", "z"};
  axes.errors.mode = NoiseMode::kExact;
  if (!vector) return;
  for (int axis = 0; axis < 3; ++axis) {
    const Element* component = vector->child(kAxes[axis]);
    const Element* noise = component ? component->child("noise") : nullptr;
    if (noise) read_axis(*noise, axis, random, axes);
  }
}

/// SDF 1.4: one block for all three axes.
void read_common(const Element* noise, Rng& random, SdfImuNoise::Axes& axes) {
  if (!noise) return;
  for (int axis = 0; axis < 3; ++axis) read_axis(*noise, axis, random, axes);
}

}  // namespace

Eigen::Vector3d SdfImuNoise::Axes::quantised(const Eigen::Vector3d& value) const {
  Eigen::Vector3d rounded = value;
  for (int axis = 0; axis < 3; ++axis) {
    const double step = precision[axis];
    if (step > 0.0) rounded[axis] = step * std::round(value[axis] / step);
  }
  return rounded;
}

SdfImuNoise read_sdf_imu_noise(const Element& imu, std::uint64_t key) {
  SdfImuNoise noise;
  Rng random(key);
  read_axes(imu.child("angular_velocity"), random, noise.rate);
  read_axes(imu.child("linear_acceleration"), random, noise.accel);
  if (const Element* old = imu.child("noise")) {
    read_common(old->child("rate"), random, noise.rate);
    read_common(old->child("accel"), random, noise.accel);
  }
  return noise;
}

}  // namespace ardee::devices
