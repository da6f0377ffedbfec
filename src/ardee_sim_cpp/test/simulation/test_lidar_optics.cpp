// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "../statistics.h"
#include "ray_posts.h"

namespace ardee {
using namespace devices;
namespace {

constexpr const char* kGpu = "libgazebo_ros_gpu_laser.so";
constexpr double kGreyReflectivity = 0.7;  // without a material
const Pose kOneMetreUp = Pose::from_xyz_rpy({0, 0, 1}, {0, 0, 0});

RayPost lidar(const std::string& keys, const std::string& horizontal = angles(1, 0.0, 0.0)) {
  RayPost post{kGpu, "gpu_ray"};
  post.horizontal = horizontal;
  post.keys = keys;
  return post;
}

LidarReading first_scan(const std::string& world_text, const RayPost& post, const Pose& pose = {}) {
  TestWorld world(world_text);
  world.spawn(post.xml(), "post", pose);
  world.run(0.1);
  return world.recorder().on<LidarReading>("/seen").at(0);
}

std::string wide_beam(double divergence_rad, const std::string& more = "") {
  return "<subRays>256</subRays><beamDivergence>" + std::to_string(divergence_rad) +
         "</beamDivergence>" + more;
}

/// Returns a board left of the x axis at 2 m, and one across it behind.
std::string edge(double behind_m, double retro_front = 0.0, double retro_behind = 0.0) {
  return board("front", 2.0, 1.0, 2.0, retro_front) +
         board("behind", behind_m, 0.0, 10.0, retro_behind);
}

TEST(LidarOptics, ABeamHalfOnAnEdgeMixesWhatIsCloseTogether) {
  // Half of the beam is at 2 m, half at 2.2 m, each weighted by its 1 / range^2.
  const double near = 0.5 / (2.0 * 2.0);
  const double far = 0.5 / (2.2 * 2.2);
  const LidarReading scan = first_scan(edge(2.2), lidar(wide_beam(0.02)));
  EXPECT_NEAR(scan.ranges_m[0], (near * 2.0 + far * 2.2) / (near + far), 0.004);
  EXPECT_NEAR(first_scan(edge(2.2), lidar("")).ranges_m[0], 2.1, 0.11) << "plain: one or the other";
}

TEST(LidarOptics, OfReturnsFarApartTheStrongestOrTheFirstCounts) {
  // The powers, half of the beam each: front 0.1 / 4, behind 0.9 / 9.
  const std::string dark_front = edge(3.0, 0.1, 0.9);
  EXPECT_NEAR(first_scan(dark_front, lidar(wide_beam(0.02))).ranges_m[0], 3.0, 1e-3);
  const std::string first = "<returnMode>first</returnMode>";
  EXPECT_NEAR(first_scan(dark_front, lidar(wide_beam(0.02, first))).ranges_m[0], 2.0, 1e-3);
  const std::string bright_front = edge(3.0, 0.9, 0.1);
  EXPECT_NEAR(first_scan(bright_front, lidar(wide_beam(0.02))).ranges_m[0], 2.0, 1e-3);
  // A longer pulse merges both.
  const std::string longer = "<pulseLength>1.5</pulseLength>";
  const double near = 0.9 / 4.0;
  const double far = 0.1 / 9.0;
  EXPECT_NEAR(first_scan(bright_front, lidar(wide_beam(0.02, longer))).ranges_m[0],
              (near * 2.0 + far * 3.0) / (near + far), 0.01);
}

/// Two walls are one step apart: beams whose footprint contains the edge mix them, with the same
/// ranges as if all beams were sampled.
TEST(LidarOptics, SamplingWhereSurfacesMixIsSamplingEverywhere) {
  for (const double step_m : {0.1, 0.25}) {
    const std::string world = edge(2.0 + step_m);
    const std::string fan = angles(81, -0.04, 0.04);  // 1 mrad apart
    const auto scan = [&](const std::string& at) {
      return first_scan(world, lidar(wide_beam(0.01, "<subRaysAt>" + at + "</subRaysAt>"), fan));
    };
    const LidarReading mixing = scan("mixing");
    const LidarReading everywhere = scan("everywhere");
    int between = 0;
    for (std::size_t beam = 0; beam < 81; ++beam) {
      EXPECT_NEAR(mixing.ranges_m[beam], everywhere.ranges_m[beam], 2e-3) << beam;
      const float range = mixing.ranges_m[beam];
      between += range > 2.01f && range < 2.0f + static_cast<float>(step_m) - 0.005f ? 1 : 0;
    }
    EXPECT_NEAR(between, 9, 2) << "a footprint of 10 mrad, beams 1 mrad apart";
  }
}

TEST(LidarOptics, OnlyNeighboursCloseEnoughTellWhereToSample) {
  // The beams are 5 mrad beside the board's edge, 50 mrad apart: each samples its own footprint.
  const RayPost sparse = lidar(wide_beam(0.02), angles(3, -0.055, 0.045));
  const float range_m = first_scan(edge(2.2), sparse).ranges_m[1];
  EXPECT_GT(range_m, 2.02f);
  EXPECT_LT(range_m, 2.19f);
}

TEST(LidarOptics, ANarrowPoleIsMetByAsManyBeamsAsTouchIt) {
  // The pole is 2 cm wide at 5 m, under beams 1 mrad apart: it spans 4 mrad, and a beam of 10 mrad
  // hits it up to 5 mrad beside it on both sides.
  const std::string pole = board("pole", 5.0, 0.0, 0.02);
  const auto count = [&](const std::string& keys) {
    const LidarReading scan = first_scan(pole, lidar(keys, angles(41, -0.02, 0.02)));
    int met = 0;
    for (const float range : scan.ranges_m) met += std::isfinite(range) ? 1 : 0;
    return met;
  };
  EXPECT_NEAR(count(""), 4, 1);
  EXPECT_NEAR(count(wide_beam(0.01, "<subRaysAt>everywhere</subRaysAt>")), 14, 1);
}

TEST(LidarOptics, ThePoleSendsBackItsShareOfTheBeam) {
  // A centred strip of half width 10 mm covers this share of a disc of radius R = 25 mm.
  const double u = 0.4;
  const double share = 2.0 / M_PI * (std::asin(u) + u * std::sqrt(1.0 - u * u));
  const LidarReading scan = first_scan(board("pole", 5.0, 0.0, 0.02),
                                       lidar(wide_beam(0.01,
                                                       "<intensityModel>lambert</intensityModel>"
                                                       "<intensityScale>100</intensityScale>")));
  EXPECT_NEAR(scan.intensities[0], 100.0 * kGreyReflectivity * share, 100.0 * 0.02);
}

TEST(LidarOptics, LambertianIntensityIsReflectivityTimesTheCosineOfIncidence) {
  const std::string green = "<material><diffuse>0.1 0.6 0.2 1</diffuse></material>";
  const std::string lambert =
      "<intensityModel>lambert</intensityModel><intensityScale>255</intensityScale>";
  const RayPost post = lidar(lambert, angles(3, -0.8, 0.8));
  const LidarReading coloured = first_scan(board("wall", 4.0, 0.0, 20.0, 0.0, green), post);
  const LidarReading retro = first_scan(board("wall", 4.0, 0.0, 20.0, 0.3, green), post);
  for (std::size_t beam = 0; beam < 3; ++beam) {
    const double cosine = beam == 1 ? 1.0 : std::cos(0.8);
    EXPECT_NEAR(coloured.intensities[beam], 255.0 * 0.6 * cosine, 1e-3);
    EXPECT_NEAR(retro.intensities[beam], 255.0 * 0.3 * cosine, 1e-3) << "laser_retro wins";
  }
}

TEST(LidarOptics, RangeEndsWhereTooLittleLightComesBack) {
  // A 10 % target is seen to 2 m: reflectivity * cos / range^2 >= 0.1 / 2^2. On a wall at 4 m the
  // range is 4 / cos, so cos^3 >= 16 * 0.1 / (4 * 0.7).
  const std::string wall = board("wall", 4.0, 0.0, 40.0);
  const std::string limit = "<reflectivityRange>2</reflectivityRange>";
  const double widest = std::acos(std::cbrt(16.0 * 0.1 / (4.0 * kGreyReflectivity)));
  for (const std::string& keys : {limit, limit + "<subRays>8</subRays>"}) {
    const LidarReading scan = first_scan(wall, lidar(keys, angles(401, -1.2, 1.2)));
    for (std::size_t beam = 0; beam < 401; ++beam) {
      const double angle = scan.angle_min_rad + double(beam) * scan.angle_increment_rad;
      if (std::abs(std::abs(angle) - widest) < 1e-3) continue;
      EXPECT_EQ(std::isfinite(scan.ranges_m[beam]), std::abs(angle) < widest) << angle;
    }
  }
  // The greatest range at normal incidence is 2 m * sqrt(reflectivity / 0.1).
  const double farthest = 2.0 * std::sqrt(0.4 / 0.1);
  EXPECT_TRUE(std::isfinite(
      first_scan(board("wall", farthest - 0.01, 0.0, 9.0, 0.4), lidar(limit)).ranges_m[0]));
  EXPECT_FALSE(std::isfinite(
      first_scan(board("wall", farthest + 0.01, 0.0, 9.0, 0.4), lidar(limit)).ranges_m[0]));
}

TEST(LidarOptics, TheShareOfDetectedPulsesFallsWithThePower) {
  // Threshold and noise: 0.1 / 8^2 / (1 + 2.326 * 0.2), and 0.2 of it. A wall across the beams at
  // range r gives 0.4 / r^2: the share is Phi((power / threshold - 1) / 0.2), 99 % at 16 m.
  const double threshold = 0.1 / 64.0 / (1.0 + 2.3263478740408408 * 0.2);
  for (const double wall_m : {14.0, 16.0, 19.0, 20.0, 25.0}) {
    RayPost post =
        lidar("<reflectivityRange>8</reflectivityRange><detectionNoise>0.2</detectionNoise>",
              angles(1001, -0.001, 0.001));
    TestWorld world(board("wall", wall_m, 0.0, 9.0, 0.4));
    world.spawn(post.xml(), "post");
    world.run(1.0);
    double beams = 0.0, detected = 0.0;
    for (const LidarReading& scan : world.recorder().on<LidarReading>("/seen")) {
      for (const float range : scan.ranges_m) {
        ++beams;
        detected += std::isfinite(range) ? 1.0 : 0.0;
      }
    }
    ASSERT_EQ(beams, 10010.0);
    const double excess = 0.4 / (wall_m * wall_m) / threshold - 1.0;
    const double share = 0.5 * std::erfc(-excess / 0.2 / std::sqrt(2.0));
    EXPECT_NEAR(detected / beams, share, kFourSigma * std::sqrt(share * (1.0 - share) / beams))
        << wall_m;
  }
}

TEST(LidarOptics, NoiseGrowsWithTheRange) {
  for (const double wall_m : {2.0, 8.0}) {
    RayPost post = lidar("<noiseGrowth>0.005</noiseGrowth>", angles(1001, -0.001, 0.001));
    post.noise = "<type>gaussian</type><mean>0</mean><stddev>0.01</stddev>";
    TestWorld world(board("wall", wall_m, 0.0, 9.0));
    world.spawn(post.xml(), "post");
    world.run(1.0);
    std::vector<double> errors;
    for (const LidarReading& scan : world.recorder().on<LidarReading>("/seen")) {
      for (const float range : scan.ranges_m) errors.push_back(static_cast<double>(range) - wall_m);
    }
    ASSERT_EQ(errors.size(), 10010u);
    const double std = 0.01 + 0.005 * wall_m;
    EXPECT_NEAR(mean_of(errors), 0.0, kFourSigma * std / std::sqrt(10010.0));
    EXPECT_NEAR(std_of(errors), std, kFourSigma * std / std::sqrt(2.0 * 10010.0));
  }
}

TEST(LidarOptics, SameBytesForAnyThreadsAndForTilesAndInstances) {
  const auto scan = [](int threads, bool flatten) {
    SimulationOptions options;
    options.rays.threads = threads;
    options.rays.local_scenes = flatten;
    TestWorld world(room() + edge(2.2), 0.001, options);
    world.spawn(
        lidar(wide_beam(0.02, "<reflectivityRange>8</reflectivityRange>"), angles(401, -M_PI, M_PI))
            .xml(),
        "post", kOneMetreUp);
    world.run(0.1);
    return world.recorder().on<LidarReading>("/seen").at(0).ranges_m;
  };
  const auto reference = scan(1, true);
  EXPECT_EQ(scan(4, true), reference);
  EXPECT_EQ(scan(2, false), reference);
}

}  // namespace
}  // namespace ardee
