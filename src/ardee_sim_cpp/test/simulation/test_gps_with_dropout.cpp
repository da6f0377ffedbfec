// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "../statistics.h"
#include "gps_rig.h"

namespace ardee {
using namespace devices;
namespace {

using Eigen::Vector3d;

std::string region_at(const std::string& keys, const Pose& pose) {
  return stand(keys, pose, 1).back().region;
}

std::vector<double> east_errors(const std::vector<GpsQualityReading>& readings) {
  std::vector<double> values;
  for (const GpsQualityReading& each : readings) values.push_back(each.error_m.x());
  return values;
}

TEST(GpsRegions, a_plot_is_its_rows_from_below_the_ground_to_the_crops_height) {
  const std::string keys = kBands + plot("3", 5.0, 1.5) + "<gaussianNoise>1</gaussianNoise>";
  EXPECT_EQ(region_at(keys, at(5)), "plot 3");
  EXPECT_EQ(region_at(keys, at(14.9, 2.9)), "plot 3");
  EXPECT_EQ(region_at(keys, at(15.1)), "");
  EXPECT_EQ(region_at(keys, at(5, 3.1)), "");
  EXPECT_EQ(region_at(keys, at(5, 0, 1.4)), "plot 3");
  EXPECT_EQ(region_at(keys, at(5, 0, 1.6)), "");  // a mast above the crop
  const std::string turned = kBands + plot("4", 5.0, 1.5, M_PI / 2);
  EXPECT_EQ(region_at(turned, at(5, 9.9)), "plot 4");
  EXPECT_EQ(region_at(turned, at(8.1, 0)), "");
}

TEST(GpsRegions, noise_is_that_of_the_present_region_only) {
  const std::string keys = kTwoPlots + kBands + "<gaussianNoise>0.1</gaussianNoise>";
  const std::size_t count = 5000;
  const struct {
    Pose pose;
    std::string region;
    double std_m;
  } cases[] = {{at(-100), "", 0.1}, {at(0), "plot 7", 0.2}, {at(30), "plot 8", 0.5}};
  for (const auto& each : cases) {
    const auto readings = stand(keys, each.pose, count);
    EXPECT_EQ(readings.back().region, each.region);
    EXPECT_NEAR(readings.back().position_std_m, each.std_m, 1e-9);
    EXPECT_NEAR(std_of(east_errors(readings)) / each.std_m, 1.0,
                kFourSigma / std::sqrt(2.0 * static_cast<double>(count)));
  }
}

TEST(GpsRegions, leaving_restores_the_open_sky) {
  const std::string keys = kTwoPlots + kBands + "<gaussianNoise>0.1</gaussianNoise>";
  TestWorld world(free_space(0.0), 0.1);
  world.spawn(ball(gps(keys)), "ball", at(-100));
  const auto go = [&world](const Pose& pose) {
    world->set_state("ball", {pose, {}}, "world");
    world.recorder().clear();
    world.run(100.0);
    return std::make_pair(quality(world).back().position_std_m,
                          std_of(east_errors(quality(world))));
  };
  const double tolerance = kFourSigma / std::sqrt(2.0 * 1000.0);
  for (int turn = 0; turn < 3; ++turn) {
    for (const auto& [x, std_m] : {std::pair{0.0, 0.2}, {30.0, 0.5}, {-100.0, 0.1}}) {
      const auto [told, found] = go(at(x));
      EXPECT_NEAR(told, std_m, 1e-9) << x;
      EXPECT_NEAR(found / std_m, 1.0, tolerance) << x;
    }
  }
}

TEST(GpsRegions, mean_multiplies_the_offset) {
  const std::string keys = plot("1", 0.0, 3.0) +
                           bands(band("2", "-1", "<mean>3</mean><variance>1</variance>")) +
                           "<offset>0.5 0 0</offset><referenceHeading>90</referenceHeading>";
  expect_near(stand(keys, at(0), 1).back().error_m, {1.5, 0, 0}, 1e-9);
  expect_near(stand(keys, at(50), 1).back().error_m, {0.5, 0, 0}, 1e-9);
}

TEST(GpsRegions, density_bands_add_to_those_of_height) {
  const std::string density =
      "<biomass_density_noise_coefficient><r1>5</r1><r2>-1</r2><mean>1</mean><variance>9"
      "</variance></biomass_density_noise_coefficient>";
  const std::string keys = plot("1", 0.0, 1.0) +
                           bands(band("0", "2", "<mean>1</mean><variance>4</variance>") + density) +
                           "<gaussianNoise>0.1</gaussianNoise>";
  EXPECT_NEAR(stand(keys, at(0), 1).back().position_std_m, 0.1 * std::sqrt(4.0 * 9.0), 1e-9);
}

TEST(GpsRegions, correlated_error_is_a_gauss_markov_process) {
  const std::size_t count = 200000;
  const std::string keys = plot("1", 0.0, 2.5) +
                           bands(band("2", "-1",
                                      "<mean>1</mean><variance>1</variance>"
                                      "<correlated_std>1.37</correlated_std>")) +
                           "<correlationTime>2</correlationTime>";
  const auto readings = stand(keys, at(0), count);
  const std::vector<double> errors = east_errors(readings);
  const double phi = std::exp(-0.1 / 2.0);
  const double independent = static_cast<double>(count) * (1 - phi * phi) / (1 + phi * phi);
  EXPECT_NEAR(std_of(errors) / 1.37, 1.0, kFourSigma / std::sqrt(2.0 * independent));
  EXPECT_NEAR(correlation_at(errors, 1), phi,
              kFourSigma * std::sqrt((1 - phi * phi) / static_cast<double>(count)));
  EXPECT_NEAR(correlation_at(errors, 20), std::exp(-1.0),
              kFourSigma * std::sqrt(2.0 / independent));
  EXPECT_NEAR(readings.back().position_std_m, 1.37, 1e-9);
}

TEST(GpsRegions, fix_is_lost_as_often_and_as_long_as_said) {
  const std::size_t count = 200000;
  const double rate_hz = 0.2, duration_s = 1.5, dt_s = 0.1;
  const std::string keys =
      plot("1", 0.0, 2.5) + bands(band("2", "-1",
                                       "<mean>1</mean><variance>1</variance>"
                                       "<fix_loss_rate>0.2</fix_loss_rate>"
                                       "<fix_loss_duration>1.5</fix_loss_duration>"));
  TestWorld world(free_space(0.0), dt_s);
  world.spawn(still(gps(keys)), "ball", at(0));
  for (std::size_t i = 0; i < count; ++i) world->step();
  std::size_t lost = 0, losses = 0;
  bool had = true;
  for (const FixReading& fix : world.recorder().on<FixReading>("/gps/fix")) {
    const bool has = fix.status == 0;
    EXPECT_EQ(std::isnan(fix.latitude_deg), !has);
    EXPECT_TRUE(has || fix.status == -1);
    lost += has ? 0 : 1;
    losses += had && !has ? 1 : 0;
    had = has;
  }
  // The process has two states: a stationary share, and the autocorrelation exp(-(a + b) dt).
  const double both_hz = rate_hz + 1.0 / duration_s;
  const double share = rate_hz / both_hz, phi = std::exp(-both_hz * dt_s);
  const double independent = static_cast<double>(count) * (1 - phi) / (1 + phi);
  EXPECT_NEAR(static_cast<double>(lost) / static_cast<double>(count), share,
              kFourSigma * std::sqrt(share * (1 - share) / independent));
  const double expected = static_cast<double>(count) * (1 - share) * share * (1 - phi);
  EXPECT_NEAR(static_cast<double>(losses), expected, kFourSigma * std::sqrt(expected));
  // Without a fix there is no velocity.
  EXPECT_EQ(world.recorder().on<VectorReading>("/fix_velocity").size(), count - lost);
}

TEST(GpsRegions, fix_comes_back_outside) {
  const std::string keys =
      plot("1", 0.0, 2.5) + bands(band("2", "-1",
                                       "<mean>1</mean><variance>1</variance>"
                                       "<fix_loss_rate>1000</fix_loss_rate>"
                                       "<fix_loss_duration>2</fix_loss_duration>"));
  TestWorld world(free_space(0.0), 0.1);
  world.spawn(ball(gps(keys)), "ball", at(0));
  world.run(1.0);
  EXPECT_FALSE(quality(world).back().has_fix);
  world->set_state("ball", {at(100), {}}, "world");
  world.run(60.0);  // 30 mean durations
  EXPECT_TRUE(quality(world).back().has_fix);
}

TEST(GpsRegions, periodic_box_draws_its_noise_anew_each_period) {
  const std::string box =
      "<periodic_noise_box><cx>0</cx><cy>0</cy><cz>0</cz><w>4</w><l>20</l><h>2</h><rot>0</rot>"
      "<nps>5</nps><nmpm>2</nmpm><nmpv>0.09</nmpv><nvpm>16</nvpm><nvpv>4</nvpv>"
      "</periodic_noise_box>";
  const std::string keys = box + "<gaussianNoise>0.1</gaussianNoise><offset>1 0 0</offset>";
  EXPECT_EQ(region_at(keys, at(0, 9)), "box 0");
  EXPECT_EQ(region_at(keys, at(3, 0)), "");
  EXPECT_EQ(region_at(keys, at(0, 0, 1.5)), "");
  TestWorld world(free_space(0.0), 0.5);
  world.spawn(still(gps(keys)), "ball", at(0));
  world.run(5.0 * 4000);
  std::vector<double> factors;
  double last = 0.0;
  std::size_t changes = 0;
  for (const GpsQualityReading& each : quality(world)) {
    const double factor = std::pow(each.position_std_m / 0.1, 2);
    factors.push_back(factor);
    changes += factor != last ? 1 : 0;
    last = factor;
  }
  EXPECT_NEAR(static_cast<double>(changes), 4000.0, 1.0);
  EXPECT_NEAR(mean_of(factors), 16.0, kFourSigma * 2.0 / std::sqrt(4000.0));
  EXPECT_NEAR(std_of(factors) / 2.0, 1.0, kFourSigma / std::sqrt(8000.0));
}

TEST(GpsRegions, periodic_boxes_draw_independently) {
  const auto box = [](const std::string& cx) {
    return "<periodic_noise_box><cx>" + cx +
           "</cx><cy>0</cy><cz>0</cz><w>4</w><l>4</l><h>2</h><rot>0</rot><nps>0.1</nps>"
           "<nmpm>1</nmpm><nmpv>0</nmpv><nvpm>16</nvpm><nvpv>4</nvpv></periodic_noise_box>";
  };
  const std::size_t count = 2000;
  const std::string keys = box("0") + box("10") + "<gaussianNoise>0.1</gaussianNoise>";
  const auto factors = [&](double x) {
    std::vector<double> values;
    for (const GpsQualityReading& each : stand(keys, at(x), count)) {
      values.push_back((std::pow(each.position_std_m / 0.1, 2) - 16.0) / 2.0);  // standardised
    }
    return values;
  };
  const std::vector<double> one = factors(0), other = factors(10);
  const double correlation = std::inner_product(one.begin(), one.end(), other.begin(), 0.0) / count;
  EXPECT_NEAR(correlation, 0.0, kFourSigma / std::sqrt(static_cast<double>(count)));
}

TEST(GpsRegions, are_shown_once) {
  TestWorld world(free_space(0.0), 0.1);
  world.spawn(still(gps(kTwoPlots + kBands)), "ball");
  world.run(1.0);
  const auto shown = world.recorder().on<RegionsReading>("/gps/regions");
  ASSERT_EQ(shown.size(), 1u);
  ASSERT_EQ(shown[0].regions.size(), 2u);
  EXPECT_EQ(shown[0].header.frame_id, "world");
  EXPECT_EQ(shown[0].regions[1].name, "plot 8");
  expect_near(shown[0].regions[1].size_m, {20, 6, 4.5}, 1e-9);
  EXPECT_GT(shown[0].regions[1].rgba[0], shown[0].regions[0].rgba[0] - 1e-6f);
}

TEST(GpsRegions, same_seed_same_errors) {
  const std::string keys = kTwoPlots + bands(band("0", "-1",
                                                  "<mean>1</mean><variance>2</variance>"
                                                  "<correlated_std>1</correlated_std>"));
  EXPECT_EQ(east_errors(stand(keys, at(0), 50)), east_errors(stand(keys, at(0), 50)));
}

}  // namespace
}  // namespace ardee
