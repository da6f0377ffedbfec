// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "../statistics.h"
#include "ardee_sim/core/error.h"
#include "ardee_sim/devices/sensor_model.h"

namespace ardee {
using namespace devices;
namespace {

constexpr std::uint64_t kKey = 20210;

Element plugin(const std::vector<std::pair<std::string, std::string>>& keys) {
  Element element{"plugin", "", {}, {}, {"robot.urdf", 1, "<plugin>"}};
  int line = 2;
  for (const auto& [name, text] : keys) {
    element.children.push_back({name, text, {}, {}, {"robot.urdf", line++, "<" + name + ">"}});
  }
  return element;
}

SensorErrors errors_of(const std::vector<std::pair<std::string, std::string>>& keys,
                       const std::string& prefix = "") {
  const Element element = plugin(keys);
  Parameters parameters(element);
  const NoiseMode mode = read_noise_mode(parameters);
  return read_sensor_errors(parameters, prefix, mode);
}

std::vector<double> samples(SensorModel& model, std::size_t count, double dt_s) {
  std::vector<double> values(count);
  for (double& value : values) value = model.corrupt(0.0, dt_s);
  return values;
}

TEST(SensorModel, defaults_leave_the_value_alone) {
  SensorModel model(errors_of({}), 3, kKey);
  const Eigen::Vector3d value(1.5, -2.0, 9.81);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(model.corrupt(value, 0.01), value);
  EXPECT_EQ(model.errors().drift_frequency_hz, Eigen::Vector3d::Constant(1.0 / 3600.0));
}

TEST(SensorModel, a_key_is_one_number_or_three_below_its_prefix) {
  const SensorErrors errors = errors_of({{"accelOffset", "0.1 0.2 0.3"},
                                         {"accelGaussianNoise", " 0.5 "},
                                         {"accelDriftFrequency", "0.25"},
                                         {"accelScaleError", "1.1"},
                                         {"gaussianNoise", "7"}},
                                        "accel");
  EXPECT_EQ(errors.offset, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(errors.gaussian_noise, Eigen::Vector3d::Constant(0.5));
  EXPECT_EQ(errors.drift_frequency_hz, Eigen::Vector3d::Constant(0.25));
  EXPECT_EQ(errors.scale_error, Eigen::Vector3d::Constant(1.1));
}

TEST(SensorModel, bad_values_are_named) {
  EXPECT_THROW(errors_of({{"drift", "-1"}}), Error);
  EXPECT_THROW(errors_of({{"gaussianNoise", "0 -1 0"}}), Error);
  EXPECT_THROW(errors_of({{"driftFrequency", "-0.1"}}), Error);
  EXPECT_THROW(errors_of({{"offset", "1 2"}}), Error);
  EXPECT_THROW(errors_of({{"offset", ""}}), Error);
  EXPECT_THROW(errors_of({{"noiseMode", "textbook"}}), Error);
  try {
    errors_of({{"offset", "0"}, {"gaussianNoise", "-2"}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("robot.urdf:3"), std::string::npos) << error.what();
  }
}

TEST(SensorModel, scale_and_offset_are_exact) {
  SensorModel model(errors_of({{"offset", "0.5"}, {"scaleError", "2"}}), 1, kKey);
  EXPECT_DOUBLE_EQ(model.corrupt(3.0, 0.1), 6.5);
  EXPECT_DOUBLE_EQ(model.bias().x(), 0.5);
}

TEST(SensorModel, white_noise_has_the_mean_and_deviation_given) {
  const double std = 0.3;
  const std::size_t count = 100000;
  SensorModel model(errors_of({{"offset", "-1"}, {"gaussianNoise", "0.3"}}), 1, kKey);
  const std::vector<double> values = samples(model, count, 0.01);
  const double root = std::sqrt(static_cast<double>(count));
  EXPECT_NEAR(mean_of(values), -1.0, kFourSigma * std / root);
  EXPECT_NEAR(std_of(values), std, kFourSigma * std / (root * std::sqrt(2.0)));
  std::vector<double> centred = values;
  for (double& value : centred) value += 1.0;
  EXPECT_NEAR(correlation_at(centred, 1), 0.0, kFourSigma / root);
}

/// Standard error of the deviation of an AR(1) series with coefficient phi, Gaussian: the squares
/// have autocorrelation phi^2k, hence (1 + phi^2) / (1 - phi^2) times the variance of a white one.
double std_error_of_ar1(double std, double phi, std::size_t count) {
  const double stretched = (1.0 + phi * phi) / (1.0 - phi * phi);
  return std * std::sqrt(stretched / (2.0 * static_cast<double>(count)));
}

TEST(SensorModel, exact_drift_has_its_deviation_at_any_rate) {
  for (const double dt_s : {0.5, 0.05}) {
    const std::size_t count = 400000;
    SensorModel model(
        errors_of({{"drift", "2"}, {"driftFrequency", "0.5"}, {"noiseMode", "exact"}}), 1, kKey);
    const std::vector<double> values = samples(model, count, dt_s);
    const double phi = std::exp(-0.5 * dt_s);
    EXPECT_NEAR(std_of(values), 2.0, kFourSigma * std_error_of_ar1(2.0, phi, count)) << dt_s;
    // Bartlett: the variance of r_1 of an AR(1) series is (1 - phi^2) / n.
    EXPECT_NEAR(correlation_at(values, 1), phi,
                kFourSigma * std::sqrt((1.0 - phi * phi) / static_cast<double>(count)))
        << dt_s;
  }
}

TEST(SensorModel, hectors_drift_settles_at_drift_times_the_root_of_dt) {
  const double dt_s = 0.25, frequency = 0.5, drift = 2.0;
  const std::size_t count = 400000;
  SensorModel model(errors_of({{"drift", "2"}, {"driftFrequency", "0.5"}}), 1, kKey);
  samples(model, 1000, dt_s);
  const std::vector<double> values = samples(model, count, dt_s);
  const double phi = std::exp(-frequency * dt_s);
  const double settled = drift * dt_s * std::sqrt(2.0 * frequency / (1.0 - phi * phi));
  EXPECT_NEAR(settled, drift * std::sqrt(dt_s), 0.07 * settled);
  EXPECT_NEAR(std_of(values), settled, kFourSigma * std_error_of_ar1(settled, phi, count));
}

TEST(SensorModel, first_drift_is_drawn_from_its_deviation_in_both_modes) {
  for (const char* mode : {"hector", "exact"}) {
    const SensorErrors errors = errors_of({{"drift", "0.5 1 2"}, {"noiseMode", mode}});
    const std::size_t count = 20000;
    std::vector<double> first[3];
    for (std::size_t i = 0; i < count; ++i) {
      const SensorModel model(errors, 3, mix_bits(i));
      for (int axis = 0; axis < 3; ++axis) first[axis].push_back(model.drift()[axis]);
    }
    const double relative = kFourSigma / std::sqrt(2.0 * static_cast<double>(count));
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(std_of(first[axis]) / errors.drift[axis], 1.0, relative) << mode;
    }
  }
}

TEST(SensorModel, same_key_and_reset_give_the_same_errors) {
  const SensorErrors errors = errors_of({{"drift", "1"}, {"gaussianNoise", "1"}});
  SensorModel one(errors, 1, kKey), other(errors, 1, kKey), third(errors, 1, kKey + 1);
  const std::vector<double> values = samples(one, 50, 0.1);
  EXPECT_EQ(values, samples(other, 50, 0.1));
  EXPECT_NE(values, samples(third, 50, 0.1));
  one.reset(0);
  EXPECT_EQ(values, samples(one, 50, 0.1));
  one.reset(kNsPerSecond);
  EXPECT_NE(values, samples(one, 50, 0.1));
}

TEST(SensorModel, a_drift_that_is_set_decays_with_its_time_constant) {
  SensorModel model(errors_of({{"driftFrequency", "0.1"}}), 3, kKey);
  model.set_drift({1, 2, 3});
  for (int i = 0; i < 100; ++i) model.next_error(0.1);
  EXPECT_TRUE(model.bias().isApprox(Eigen::Vector3d(1, 2, 3) * std::exp(-1.0), 1e-12));
}

TEST(SensorModel, tuning_has_the_names_and_bounds_of_hector) {
  SensorModel model(errors_of({{"gaussianNoise", "1 2 3"}}), 3, kKey);
  const ParameterGroup tuning = model.tuning("imu/accel");
  ASSERT_EQ(tuning.parameters.size(), 5u);
  EXPECT_EQ(tuning.name, "imu/accel");
  EXPECT_EQ(tuning.parameters[0].name, "gaussian_noise");
  EXPECT_EQ(tuning.parameters[0].get(), 2.0);
  EXPECT_EQ(tuning.parameters[1].low, -10.0);
  EXPECT_EQ(tuning.parameters[3].high, 1.0);
  tuning.parameters[0].set(0.5);
  EXPECT_EQ(model.errors().gaussian_noise, Eigen::Vector3d::Constant(0.5));
}

}  // namespace
}  // namespace ardee
