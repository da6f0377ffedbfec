// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../statistics.h"
#include "ray_posts.h"

namespace ardee {
using namespace devices;
namespace {

constexpr const char* kRange = "libgazebo_ros_range.so";
constexpr const char* kSonar = "libhector_gazebo_ros_sonar.so";
constexpr const char* kBlock = "libgazebo_ros_block_laser.so";
constexpr float kInfinity = std::numeric_limits<float>::infinity();
const Pose kOneMetreUp = Pose::from_xyz_rpy({0, 0, 1}, {0, 0, 0});

RayPost cone(const char* plugin, const std::string& keys = "") {
  RayPost post{plugin};
  post.horizontal = angles(21, -0.2, 0.2);
  post.vertical = angles(5, -0.05, 0.05);
  post.keys = keys;
  return post;
}

class RangeFinders : public testing::TestWithParam<const char*> {};

TEST_P(RangeFinders, TellTheNearestThingInTheirCone) {
  TestWorld world(room());
  // Turned by 0.6 rad, the cone spans 0.4 to 0.8 rad, with the front wall at 5 m / cos and the side
  // wall at 3 m / sin; the rows fan out by cos(elevation), the middle one is level.
  world.spawn(cone(GetParam()).xml(), "post", Pose::from_xyz_rpy({0, 0, 1}, {0, 0, 0.6}));
  world.run(0.1);
  const auto readings = world.recorder().on<RangeReading>("/seen");
  ASSERT_EQ(readings.size(), 1u);
  EXPECT_NEAR(readings[0].range_m, std::min(5.0 / std::cos(0.4), 3.0 / std::sin(0.8)), 1e-5);
  EXPECT_EQ(readings[0].radiation, RangeReading::Radiation::kUltrasound);
  EXPECT_DOUBLE_EQ(readings[0].range_min_m, 0.1);
  EXPECT_DOUBLE_EQ(readings[0].range_max_m, 30.0);
}

TEST_P(RangeFinders, TellTheirMaximumWithoutAReturnAndTheirMinimumTooNear) {
  const std::string noise = "<gaussianNoise>0.5</gaussianNoise>";
  const auto ranges = [&](const std::string& world_text) {
    RayPost post = cone(GetParam(), noise);
    post.range = "<min>0.3</min><max>4.1</max>";
    TestWorld world(world_text);
    world.spawn(post.xml(), "post", kOneMetreUp);
    world.run(1.0);
    std::vector<double> told;
    for (const auto& each : world.recorder().on<RangeReading>("/seen")) {
      told.push_back(each.range_m);
    }
    return told;
  };
  EXPECT_EQ(ranges(""), std::vector<double>(10, 4.1)) << "no noise on what is no return";
  EXPECT_EQ(ranges(static_box("near", "0.3 0 1 0 0 0", "0.2 1 1")), std::vector<double>(10, 0.3));
  for (const double range : ranges(room())) EXPECT_EQ(range, 4.1);  // 5 m away
  for (const double range : ranges(static_box("box", "4 0 1 0 0 0", "1 4 4"))) {
    EXPECT_GE(range, 0.3);
    EXPECT_LE(range, 4.1);
  }
}

TEST_P(RangeFinders, NoiseHasTheStatedMeanAndDeviation) {
  constexpr double kStd = 0.02;
  RayPost post = cone(GetParam(), "<gaussianNoise>0.02</gaussianNoise>");
  post.horizontal = angles(3, -0.2, 0.2);
  TestWorld world(room(), 0.02);
  world.spawn(post.xml(), "post", kOneMetreUp);
  world.run(200.0);
  std::vector<double> errors;
  for (const auto& each : world.recorder().on<RangeReading>("/seen")) {
    errors.push_back(each.range_m - 5.0);
  }
  ASSERT_EQ(errors.size(), 2000u);
  EXPECT_NEAR(mean_of(errors), 0.0, kFourSigma * kStd / std::sqrt(2000.0));
  EXPECT_NEAR(std_of(errors), kStd, kFourSigma * kStd / std::sqrt(4000.0));
}

INSTANTIATE_TEST_SUITE_P(Both, RangeFinders, testing::Values(kRange, kSonar),
                         [](const auto& each) { return each.param == kRange ? "range" : "sonar"; });

TEST(Range, TellsTheFieldOfViewAndRadiationOfItsKeys) {
  TestWorld world(room());
  RayPost post = cone(kRange,
                      "<fov>0.12</fov><radiation>INFRARED</radiation>"
                      "<updateRate>5</updateRate><frameName>nose</frameName>");
  world.spawn(post.xml(), "post", kOneMetreUp);
  world.run(1.0);
  const auto readings = world.recorder().on<RangeReading>("/seen");
  EXPECT_EQ(readings.size(), 5u) << "the slower of both rates";
  EXPECT_DOUBLE_EQ(readings.at(0).field_of_view_rad, 0.12);
  EXPECT_EQ(readings.at(0).radiation, RangeReading::Radiation::kInfrared);
  EXPECT_EQ(readings.at(0).header.frame_id, "nose");
}

TEST(Sonar, TellsTheSmallerSpanTenTimesASecond) {
  TestWorld world(room());
  RayPost post = cone(kSonar);
  post.rate = "";
  world.spawn(post.xml(), "post", kOneMetreUp);
  world.run(1.0);
  const auto readings = world.recorder().on<RangeReading>("/seen");
  EXPECT_EQ(readings.size(), 10u);
  EXPECT_NEAR(readings.at(0).field_of_view_rad, 0.1, 1e-12);
  EXPECT_EQ(readings.at(0).header.frame_id, "sonar_link");
}

TEST(Sonar, HasHectorsOffsetAndScale) {
  TestWorld world(room());
  world.spawn(cone(kSonar, "<offset>0.1</offset><scaleError>1.02</scaleError>").xml(), "post",
              kOneMetreUp);
  world.run(0.1);
  EXPECT_NEAR(world.recorder().on<RangeReading>("/seen").at(0).range_m, 5.0 * 1.02 + 0.1, 1e-5);
}

TEST(Sonar, NoiseDoesNotDependOnWhoListens) {
  const auto last = [](bool listen_always) {
    TestWorld world(room());
    Entity& post =
        world.spawn(cone(kSonar, "<gaussianNoise>0.02</gaussianNoise><drift>0.1</drift>").xml(),
                    "post", kOneMetreUp);
    Output& output = post.devices[0]->ports().all<Output>()[0];
    output.demanded = listen_always;
    world.run(0.5);
    output.demanded = true;
    world.run(0.1);
    return world.recorder().on<RangeReading>("/seen").back().range_m;
  };
  EXPECT_EQ(last(true), last(false));
}

TEST(BlockLaser, GivesAPointForEachBeamRowByRow) {
  RayPost post{kBlock};
  post.horizontal = angles(3, -0.4, 0.4);
  post.vertical = angles(2, -0.2, 0.2);
  TestWorld world(room());
  world.spawn(post.xml(), "post", kOneMetreUp);
  world.run(0.1);
  const LegacyCloudReading cloud = world.recorder().on<LegacyCloudReading>("/seen").at(0);
  EXPECT_EQ(cloud.channel_name, "");
  ASSERT_EQ(cloud.points.size(), 6u);
  ASSERT_EQ(cloud.channel.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k) {
    const double azimuth = -0.4 + 0.4 * double(k % 3);
    const double elevation = k < 3 ? -0.2 : 0.2;
    const Eigen::Vector3d expected(5.0, 5.0 * std::tan(azimuth),
                                   5.0 / std::cos(azimuth) * std::tan(elevation));
    EXPECT_LT((cloud.points[k].cast<double>() - expected).norm(), 3e-6) << "point " << k;
    EXPECT_NEAR(cloud.channel[k], std::cos(azimuth) * std::cos(elevation), 1e-6);
  }
}

TEST(BlockLaser, SaysByREP117WhatHasNoRange) {
  RayPost post{kBlock};
  post.horizontal = angles(2, 0.0, M_PI);
  post.range = "<min>1</min><max>4</max>";
  TestWorld world(static_box("near", "0.5 0 0 0 0 0", "0.2 1 1"));
  world.spawn(post.xml(), "post");
  world.run(0.1);
  const LegacyCloudReading cloud = world.recorder().on<LegacyCloudReading>("/seen").at(0);
  EXPECT_EQ(cloud.points.at(0), Eigen::Vector3f::Constant(-kInfinity));
  EXPECT_EQ(cloud.points.at(1), Eigen::Vector3f::Constant(kInfinity));
}

TEST(BlockLaser, NoiseIsOnEachCoordinate) {
  constexpr double kStd = 0.05;
  RayPost post{kBlock};
  post.horizontal = angles(2001, -1e-6, 1e-6);
  post.keys = "<gaussianNoise>0.05</gaussianNoise>";
  TestWorld world(room());
  world.spawn(post.xml(), "post", kOneMetreUp);
  world.run(0.1);
  const LegacyCloudReading cloud = world.recorder().on<LegacyCloudReading>("/seen").at(0);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> errors;
    for (const Eigen::Vector3f& point : cloud.points) {
      errors.push_back(static_cast<double>(point[axis]) - (axis == 0 ? 5.0 : 0.0));
    }
    EXPECT_NEAR(mean_of(errors), 0.0, kFourSigma * kStd / std::sqrt(2001.0));
    EXPECT_NEAR(std_of(errors), kStd, kFourSigma * kStd / std::sqrt(2.0 * 2001.0));
  }
}

// Gazebo reads a rate of 0, and none, as "as fast as possible".
class RateOfZero : public testing::TestWithParam<const char*> {};

TEST_P(RateOfZero, MeasuresAtEachStep) {
  constexpr double kStep_s = 0.005;
  constexpr std::size_t kSteps = 20;
  for (const char* rate : {"", "<update_rate>0</update_rate>"}) {
    RayPost post = cone(GetParam(), "<updateRate>0</updateRate>");
    post.vertical.clear();
    post.rate = rate;
    TestWorld world(room(), kStep_s);
    const Entity& robot = world.spawn(post.xml(), "post");
    ASSERT_EQ(robot.devices.size(), 1u) << rate;
    world.run(kStep_s * kSteps);
    EXPECT_EQ(world.recorder().count("/seen"), kSteps) << rate;
  }
}

INSTANTIATE_TEST_SUITE_P(Each, RateOfZero,
                         testing::Values(kRange, kSonar, kBlock, "libgazebo_ros_laser.so",
                                         "libgazebo_ros_gpu_laser.so",
                                         "libgazebo_ros_velodyne_laser.so",
                                         "libgazebo_ros_velodyne_gpu_laser.so"),
                         [](const auto& each) {
                           const std::string file = each.param;
                           return file.substr(0, file.find('.'));
                         });

// A sensor with a bad value is left out with one message; the robot stays.
struct BadSensor {
  const char* what;
  const char* plugin;
  void (*spoil)(RayPost&);
  const char* message;
};

const BadSensor kBadSensors[] = {
    {"no_rays", kSonar, [](RayPost& p) { p.horizontal = "<samples>0</samples>"; }, "found 0"},
    {"too_many_rays", "libgazebo_ros_velodyne_laser.so",
     [](RayPost& p) {
       p.horizontal = angles(100000, -1, 1);
       p.vertical = angles(64, -0.2, 0.2);
     },
     "found 100000 x 64 rays"},
    {"too_many_sub_rays", "libgazebo_ros_velodyne_laser.so",
     [](RayPost& p) {
       p.horizontal = angles(100000, -1, 1);
       p.keys = "<subRays>256</subRays>";
     },
     "25600000 rays with all sub-rays"},
    {"crossed_range", kRange, [](RayPost& p) { p.range = "<min>3</min><max>2</max>"; },
     "expected more than <min>"},
    {"crossed_rings", kBlock, [](RayPost& p) { p.vertical = angles(4, 0.2, -0.2); },
     "expected more than <min_angle>"},
    {"crossed_velodyne_range", "libgazebo_ros_velodyne_gpu_laser.so",
     [](RayPost& p) { p.keys = "<min_range>5</min_range><max_range>5</max_range>"; },
     "expected more than <min_range>"},
    {"negative_noise", kSonar, [](RayPost& p) { p.keys = "<gaussianNoise>-1</gaussianNoise>"; },
     "expected no number below zero"},
    {"negative_sdf_noise", "libgazebo_ros_laser.so",
     [](RayPost& p) { p.noise = "<type>gaussian</type><stddev>-0.1</stddev>"; }, "found -0.1"},
    {"negative_rate", kRange, [](RayPost& p) { p.rate = "<update_rate>-5</update_rate>"; },
     "found -5, expected a number"},
    {"negative_velodyne_rate", "libgazebo_ros_velodyne_laser.so",
     [](RayPost& p) { p.rate = "<update_rate>-5</update_rate>"; }, "found -5"},
    {"negative_sonar_rate", kSonar, [](RayPost& p) { p.keys = "<updateRate>-1</updateRate>"; },
     "found -1"},
    {"radiation", kRange, [](RayPost& p) { p.keys = "<radiation>sound</radiation>"; },
     "expected ultrasound or infrared"},
    {"intensity_model", "libgazebo_ros_gpu_laser.so",
     [](RayPost& p) { p.keys = "<intensityModel>phong</intensityModel>"; },
     "expected plain or lambert"},
    {"divergence", "libgazebo_ros_gpu_laser.so",
     [](RayPost& p) { p.keys = "<beamDivergence>3</beamDivergence>"; }, "found 3"},
    {"no_sub_rays", "libgazebo_ros_gpu_laser.so",
     [](RayPost& p) { p.keys = "<subRays>0</subRays>"; }, "found 0"},
};

class BadRangeSensor : public testing::TestWithParam<BadSensor> {};

TEST_P(BadRangeSensor, IsLeftOutWithOneMessage) {
  RayPost post = cone(GetParam().plugin);
  post.vertical.clear();
  GetParam().spoil(post);
  TestWorld world("");
  const Entity& robot = world.spawn(post.xml(), "post");
  EXPECT_TRUE(robot.devices.empty());
  ASSERT_EQ(world.messages().size(), 1u);
  EXPECT_NE(world.messages()[0].find(GetParam().message), std::string::npos) << world.messages()[0];
  const std::string named = "sensor 'eye' (" + std::string(GetParam().plugin) + ") is left out";
  EXPECT_NE(world.messages()[0].find(named), std::string::npos) << world.messages()[0];
  world.run(0.2);
}

INSTANTIATE_TEST_SUITE_P(Each, BadRangeSensor, testing::ValuesIn(kBadSensors),
                         [](const auto& each) { return std::string(each.param.what); });

}  // namespace
}  // namespace ardee
