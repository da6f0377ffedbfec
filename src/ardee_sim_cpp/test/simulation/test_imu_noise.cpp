// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "../statistics.h"
#include "ardee_sim/devices/vibration.h"
#include "motion_rig.h"

namespace ardee {
using namespace devices;
namespace {

using Eigen::Vector3d;

constexpr double kStep_s = 0.01;

std::vector<double> rates_z(const std::string& keys, std::size_t count, std::uint64_t seed = 1) {
  SimulationOptions options;
  options.seed = seed;
  TestWorld world(free_space(-9.81), kStep_s, options);
  world.spawn(still(plugin("hector_gazebo_ros_imu", keys)), "ball");
  for (std::size_t i = 0; i < count; ++i) world->step();
  std::vector<double> values;
  for (const ImuReading& reading : world.recorder().on<ImuReading>("/imu")) {
    values.push_back(reading.angular_velocity.z());
  }
  return values;
}

TEST(ImuNoise, white_noise_falls_as_the_root_of_the_averaging_time) {
  const double std = 0.02;
  const std::size_t count = 100000;
  const std::vector<double> values = rates_z("<rateGaussianNoise>0.02</rateGaussianNoise>", count);
  ASSERT_EQ(values.size(), count);
  const double n = std * std::sqrt(kStep_s);  // angle random walk, rad/s/sqrt(Hz)
  std::vector<double> slopes;
  for (const std::size_t window : {1u, 4u, 16u, 64u}) {
    const double tau_s = static_cast<double>(window) * kStep_s;
    // IEEE Std 952-1997, C.1.8: relative error 1 / sqrt(2 (count / window - 1)).
    const double error = kFourSigma / std::sqrt(2.0 * (static_cast<double>(count / window) - 1.0));
    EXPECT_NEAR(allan_deviation(values, window) * std::sqrt(tau_s) / n, 1.0, error) << window;
  }
  const double slope =
      std::log(allan_deviation(values, 64) / allan_deviation(values, 1)) / std::log(64.0);
  EXPECT_NEAR(slope, -0.5, 0.02);
}

TEST(ImuNoise, exact_drift_has_the_peak_of_a_gauss_markov_process) {
  const double drift = 0.05, time_constant_s = 0.5;
  const std::size_t count = 200000;
  const std::vector<double> values = rates_z(
      "<noiseMode>exact</noiseMode><rateDrift>0.05</rateDrift><rateDriftFrequency>2"
      "</rateDriftFrequency>",
      count);
  double largest = 0.0, at_s = 0.0;
  for (const std::size_t window : {10u, 25u, 50u, 95u, 180u, 400u}) {
    const double tau_s = static_cast<double>(window) * kStep_s;
    const double ratio = tau_s / time_constant_s;
    // IEEE Std 952-1997, eq. C.17, with q_c^2 = 2 drift^2 / T.
    const double variance =
        2.0 * drift * drift / ratio *
        (1.0 - (3.0 - 4.0 * std::exp(-ratio) + std::exp(-2.0 * ratio)) / (2.0 * ratio));
    const double error = kFourSigma / std::sqrt(2.0 * (static_cast<double>(count / window) - 1.0));
    const double found = allan_deviation(values, window);
    EXPECT_NEAR(found / std::sqrt(variance), 1.0, error) << tau_s;
    if (found > largest) {
      largest = found;
      at_s = tau_s;
    }
  }
  EXPECT_NEAR(at_s, 1.89 * time_constant_s, 0.1);  // 0.95 s, the middle of the windows
  EXPECT_NEAR(largest, 0.618 * drift, 0.1 * drift);
}

TEST(ImuNoise, same_seed_same_bytes_another_seed_another_noise) {
  const std::string keys =
      "<rateGaussianNoise>0.1</rateGaussianNoise><rateDrift>0.1</rateDrift>"
      "<vibrationStdAccel>1 1 1</vibrationStdAccel>";
  const std::vector<double> values = rates_z(keys, 100, 7);
  EXPECT_EQ(values, rates_z(keys, 100, 7));
  EXPECT_NE(values, rates_z(keys, 100, 8));
}

TEST(ImuNoise, goes_on_the_same_whoever_listens_and_begins_again_with_the_simulation) {
  const std::string robot = still(plugin("hector_gazebo_ros_imu",
                                         "<accelGaussianNoise>1</accelGaussianNoise>"
                                         "<accelDrift>1</accelDrift>"));
  TestWorld heard(""), unheard("");
  heard.spawn(robot, "ball");
  Entity& other = unheard.spawn(robot, "ball");
  const auto last = [](TestWorld& world) {
    return world.recorder().on<ImuReading>("/imu").back().linear_acceleration;
  };
  for (Output& output : other.devices[0]->ports().all<Output>()) output.demanded = false;
  heard.run(0.05);
  unheard.run(0.05);
  EXPECT_TRUE(unheard.recorder().on<ImuReading>("/imu").empty());
  for (Output& output : other.devices[0]->ports().all<Output>()) output.demanded = true;
  heard.run(0.05);
  unheard.run(0.05);
  const Vector3d value = last(heard);
  EXPECT_EQ(value, last(unheard));
  heard->reset_simulation();
  heard.run(0.1);
  EXPECT_EQ(last(heard), value);
}

TEST(ImuNoise, stock_sensor_adds_sdf_noise_and_its_own) {
  const auto axis = [](const char* name, const char* mean, const char* std) {
    return std::string("<") + name + "><noise type='gaussian'><mean>" + mean + "</mean><stddev>" +
           std + "</stddev></noise></" + name + ">";
  };
  const std::string sensor =
      "<sensor name='s' type='imu'><update_rate>0</update_rate><imu><angular_velocity>" +
      axis("x", "0", "0") + axis("y", "0.5", "0.3") + "</angular_velocity><linear_acceleration>" +
      axis("z", "-1", "0.4") + "</linear_acceleration></imu>" +
      plugin("gazebo_ros_imu_sensor",
             "<frameName>f</frameName><updateRateHZ>0</updateRateHZ><gaussianNoise>0.1"
             "</gaussianNoise>") +
      "</sensor>";
  const std::size_t count = 40000;
  TestWorld world(free_space(-9.81), kStep_s);
  world.spawn(ball("", "<static>true</static>", sensor), "ball");
  for (std::size_t i = 0; i < count; ++i) world->step();
  std::vector<double> rate_x, rate_y, accel_z, roll;
  for (const ImuReading& reading : world.recorder().on<ImuReading>("/imu_data")) {
    rate_x.push_back(reading.angular_velocity.x());
    rate_y.push_back(reading.angular_velocity.y());
    accel_z.push_back(reading.linear_acceleration.z());
    EXPECT_NEAR(reading.orientation.norm(), 1.0, 1e-12);
    roll.push_back(reading.orientation.x());
  }
  ASSERT_EQ(rate_x.size(), count);
  const double relative = kFourSigma / std::sqrt(2.0 * static_cast<double>(count));
  EXPECT_NEAR(std_of(rate_x) / 0.1, 1.0, relative);
  EXPECT_NEAR(std_of(rate_y) / std::hypot(0.3, 0.1), 1.0, relative);
  EXPECT_NEAR(std_of(accel_z) / std::hypot(0.4, 0.1), 1.0, relative);
  EXPECT_NEAR(mean_of(rate_y), 0.5, 0.01);
  EXPECT_NEAR(mean_of(accel_z), 9.81 - 1.0, 0.01);
  EXPECT_NEAR(std_of(roll), 0.1, 0.003);  // to first order
}

TEST(ImuNoise, stock_sensor_quantises_and_has_a_bias_and_a_drift) {
  const std::string sensor =
      "<sensor name='s' type='imu'><update_rate>0</update_rate><imu><noise><type>gaussian</type>"
      "<rate><mean>0</mean><stddev>0</stddev><bias_mean>0.2</bias_mean><bias_stddev>0</bias_stddev>"
      "</rate><accel><type>gaussian_quantized</type><mean>0</mean><stddev>0.3</stddev>"
      "<precision>0.25</precision></accel></noise></imu>" +
      plugin("gazebo_ros_imu_sensor", "<frameName>f</frameName><updateRateHZ>0</updateRateHZ>") +
      "</sensor>";
  TestWorld world(free_space(-9.81), kStep_s);
  world.spawn(ball("", "<static>true</static>", sensor), "ball");
  world.run(1.0);
  ASSERT_EQ(world.recorder().on<ImuReading>("/imu_data").size(), 100u);
  for (const ImuReading& reading : world.recorder().on<ImuReading>("/imu_data")) {
    EXPECT_NEAR(std::abs(reading.angular_velocity.y()), 0.2, 1e-12);  // of either sign
    EXPECT_NEAR(std::remainder(reading.linear_acceleration.x(), 0.25), 0.0, 1e-12);
  }
}

TEST(ImuNoise, stock_sensor_measures_once_a_second_unless_told) {
  const std::string sensor = "<sensor name='s' type='imu'><update_rate>100</update_rate>" +
                             plugin("gazebo_ros_imu_sensor", "<frameName>f</frameName>") +
                             "</sensor>";
  TestWorld world(free_space(-9.81), kStep_s);
  world.spawn(ball("", "<static>true</static>", sensor), "ball");
  world.run(3.5);
  EXPECT_EQ(world.recorder().on<ImuReading>("/imu_data").size(), 3u);
  ASSERT_EQ(world.messages().size(), 1u);
  EXPECT_NE(world.messages()[0].find("found no <updateRateHZ>, expected one"), std::string::npos);
}

TEST(Vibration, has_its_deviation_and_its_band_at_any_step) {
  for (const double dt_s : {0.001, 0.005}) {
    BandNoise noise(3.0, 20.0);
    Rng random(3);
    std::vector<double> values(200000);
    for (double& value : values) value = noise.next(random.normal(), dt_s);
    // A band of 17 Hz has about 2 * 17 independent values a second.
    const double independent = 34.0 * dt_s * static_cast<double>(values.size());
    EXPECT_NEAR(std_of(values), 1.0, kFourSigma / std::sqrt(independent)) << dt_s;
    EXPECT_NEAR(mean_of(values), 0.0, 1e-3);
  }
}

/// Returns the amplitude of the output for a sine of a frequency.
double response(double frequency_hz) {
  BandNoise noise(3.0, 20.0);
  const double dt_s = 0.001;
  double largest = 0.0;
  for (int i = 0; i < 8000; ++i) {
    const double value = noise.next(std::sin(2.0 * M_PI * frequency_hz * i * dt_s), dt_s);
    if (i > 4000) largest = std::max(largest, std::abs(value));
  }
  return largest;
}

TEST(Vibration, passes_its_band_only) {
  const double middle = response(std::sqrt(3.0 * 20.0));
  // The filter is of second order: at a corner the root of a half, a factor of 10 off it a
  // hundredth.
  EXPECT_NEAR(response(3.0) / middle, M_SQRT1_2, 0.03);
  EXPECT_NEAR(response(20.0) / middle, M_SQRT1_2, 0.03);
  EXPECT_NEAR(response(0.3) / middle, 0.01, 0.002);
  EXPECT_LT(response(200.0) / middle, 0.011);
}

/// Returns the share of the deviation of a band of 3 to 20 Hz (Butterworth of second order) that
/// remains in means over a time: white noise through the filters and through sin(pi f T) / (pi f
/// T).
double kept_of_vibration(double mean_s) {
  double all = 0.0, kept = 0.0;
  for (double f = 0.005; f < 500.0; f += 0.01) {
    const double high = std::pow(f / 3.0, 4), low = std::pow(f / 20.0, 4);
    const double power = high / (1.0 + high) / (1.0 + low);
    const double phase = M_PI * f * mean_s;
    all += power;
    kept += power * std::pow(std::sin(phase) / phase, 2);
  }
  return std::sqrt(kept / all);
}

TEST(Vibration, grows_with_the_speed_is_none_at_rest_and_a_mean_over_the_sample) {
  for (const double rate_hz : {50.0, 10.0}) {
    TestWorld world(free_space(0.0), 0.001);
    world.spawn(ball(plugin("hector_gazebo_ros_imu",
                            "<vibrationStdAccel>2 1 4</vibrationStdAccel><vibrationSpeed>0.8"
                            "</vibrationSpeed><updateRate>" +
                                std::to_string(rate_hz) + "</updateRate>")),
                "ball");
    world.run(1.0);
    for (const ImuReading& reading : world.recorder().on<ImuReading>("/imu")) {
      expect_near(reading.linear_acceleration, Vector3d::Zero(), 1e-9);
    }
    world->set_state("ball", {Pose{}, {{0.3, 0.4, 0.0}, {0, 0, 0}}}, "world");
    world.run(1.0);
    world.recorder().clear();
    world.run(60.0);
    std::vector<double> x, z;
    for (const ImuReading& reading : world.recorder().on<ImuReading>("/imu")) {
      x.push_back(reading.linear_acceleration.x());
      z.push_back(reading.linear_acceleration.z());
    }
    ASSERT_EQ(x.size(), static_cast<std::size_t>(60.0 * rate_hz));
    const double kept = kept_of_vibration(1.0 / rate_hz);
    EXPECT_NEAR(kept, rate_hz == 50.0 ? 0.838 : 0.322, 1e-3);
    const double independent = std::min(34.0, rate_hz) * 60.0;
    const double relative = kFourSigma / std::sqrt(independent);
    EXPECT_NEAR(std_of(x) / (2.0 * 0.5 / 0.8 * kept), 1.0, relative) << rate_hz;
    EXPECT_NEAR(std_of(z) / (4.0 * 0.5 / 0.8 * kept), 1.0, relative) << rate_hz;
  }
}

}  // namespace
}  // namespace ardee
