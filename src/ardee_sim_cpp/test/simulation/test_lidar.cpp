// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "fixture.h"

namespace ardee {
using namespace devices;
namespace {

constexpr const char* kGpu = "libgazebo_ros_gpu_laser.so";
constexpr const char* kRay = "libgazebo_ros_laser.so";
const Pose kOneMetreUp = Pose::from_xyz_rpy({0, 0, 1}, {0, 0, 0});

/// Returns the distance from the origin to the walls of room() along an angle.
double room_range(double angle) {
  return std::min(5.0 / std::abs(std::cos(angle)), 3.0 / std::abs(std::sin(angle)));
}

class LidarPlugin : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(LidarPlugin, MeasuresARoomExactly) {
  TestWorld world(room());
  world.spawn(lidar_post(GetParam().first, GetParam().second, 1081), "post", kOneMetreUp);
  world.run(0.025);
  const auto scans = world.recorder().on<LidarReading>("/scan");
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_EQ(scans[0].header.stamp_ns, 25000000);
  EXPECT_EQ(scans[0].header.frame_id, "mast");
  ASSERT_EQ(scans[0].ranges_m.size(), 1081u);
  for (std::size_t beam = 0; beam < 1081; ++beam) {
    const double angle = scans[0].angle_min_rad + beam * scans[0].angle_increment_rad;
    ASSERT_NEAR(scans[0].ranges_m[beam], room_range(angle), 2e-6) << "beam " << beam;
  }
}

TEST_P(LidarPlugin, KeepsItsRate) {
  TestWorld world(room(), 0.007);
  world.spawn(lidar_post(GetParam().first, GetParam().second, 3), "post", kOneMetreUp);
  world.run(7.0);
  EXPECT_EQ(world.recorder().on<LidarReading>("/scan").size(), 280u);
}

INSTANTIATE_TEST_SUITE_P(Both, LidarPlugin,
                         testing::Values(std::make_pair(kRay, "ray"),
                                         std::make_pair(kGpu, "gpu_ray")),
                         [](const auto& both) { return std::string(both.param.second); });

TEST(Lidar, NoiseHasTheStatedMeanAndDeviation) {
  constexpr double kStd = 0.02;
  TestWorld world(room());
  world.spawn(lidar_post(kGpu, "gpu_ray", 1081, kStd), "post", kOneMetreUp);
  world.run(1.0);
  double sum = 0.0;
  double squares = 0.0;
  int count = 0;
  for (const LidarReading& scan : world.recorder().on<LidarReading>("/scan")) {
    for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
      const double angle = scan.angle_min_rad + beam * scan.angle_increment_rad;
      const double error = scan.ranges_m[beam] - room_range(angle);
      sum += error;
      squares += error * error;
      ++count;
    }
  }
  ASSERT_EQ(count, 40 * 1081);
  // The bound is four standard errors.
  EXPECT_NEAR(sum / count, 0.0, 4.0 * kStd / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(squares / count), kStd, 4.0 * kStd / std::sqrt(2.0 * count));
}

TEST(Lidar, QuantisedNoiseGivesMultiplesOfItsPrecision) {
  TestWorld world(room());
  std::string post = lidar_post(kGpu, "gpu_ray", 1081);
  const std::string type = "<type>gaussian</type>";
  post.replace(post.find(type), type.size(),
               "<type>gaussian_quantized</type><precision>0.25</precision>");
  world.spawn(post, "post", kOneMetreUp);
  world.run(0.025);
  const LidarReading scan = world.recorder().on<LidarReading>("/scan").at(0);
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const double angle = scan.angle_min_rad + beam * scan.angle_increment_rad;
    ASSERT_EQ(scan.ranges_m[beam], 0.25f * std::round(scan.ranges_m[beam] / 0.25f));
    ASSERT_NEAR(scan.ranges_m[beam], room_range(angle), 0.125 + 1e-5);
  }
}

TEST(Lidar, NoiseDoesNotDependOnWhoListens) {
  const auto last_scan = [](bool listen_always) {
    TestWorld world(room());
    Entity& post = world.spawn(lidar_post(kGpu, "gpu_ray", 11, 0.05), "post", kOneMetreUp);
    Output& output = post.devices[0]->ports().all<Output>()[0];
    output.demanded = listen_always;
    world.run(0.5);
    output.demanded = true;
    world.run(0.025);
    return world.recorder().on<LidarReading>("/scan").back().ranges_m;
  };
  EXPECT_EQ(last_scan(true), last_scan(false));
}

TEST(Lidar, NearerThanTheMinimumIsMinusInfinityUnlessToldToLookThrough) {
  const std::string world_text = static_box("near", "0.5 0 0 0 0 0", "0.2 1 1") + room();
  const std::string range = "<min>1.0</min><max>30</max>";
  TestWorld blocked(world_text);
  blocked.spawn(lidar_post(kRay, "ray", 1081, 0.0, "", range), "post");
  blocked.run(0.025);
  const LidarReading scan = blocked.recorder().on<LidarReading>("/scan").front();
  EXPECT_EQ(scan.ranges_m[540], -std::numeric_limits<float>::infinity());

  TestWorld through(world_text);
  through.spawn(
      lidar_post(kRay, "ray", 1081, 0.0, "<lookThroughNear>true</lookThroughNear>", range), "post");
  through.run(0.025);
  EXPECT_NEAR(through.recorder().on<LidarReading>("/scan").front().ranges_m[540], 5.0, 1e-5);
}

TEST(Lidar, LooksThroughItsOwnRobotNearerThanTheMinimum) {
  std::string post = lidar_post(kRay, "ray", 1081);
  const std::string ball = "<geometry><sphere><radius>%R</radius></sphere></geometry>";
  const std::string end = "</model>";
  const auto with_housing = [&](const std::string& radius) {
    std::string shape = ball;
    shape.replace(shape.find("%R"), 2, radius);
    std::string xml = post;
    return xml.insert(xml.find(end),
                      "<link name='housing'><collision name='c'>" + shape + "</collision></link>");
  };
  TestWorld inside(room());
  inside.spawn(with_housing("0.05"), "post", kOneMetreUp);
  inside.run(0.025);
  const LidarReading scan = inside.recorder().on<LidarReading>("/scan").front();
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const double angle = scan.angle_min_rad + beam * scan.angle_increment_rad;
    ASSERT_NEAR(scan.ranges_m[beam], room_range(angle), 2e-6) << "beam " << beam;
  }
  TestWorld behind(room());
  behind.spawn(with_housing("0.2"), "post", kOneMetreUp);
  behind.run(0.025);
  EXPECT_NEAR(behind.recorder().on<LidarReading>("/scan").front().ranges_m[540], 0.2, 2e-6)
      << "what is farther than the minimum is in the way, the robot's own too";
}

TEST(Lidar, BeyondTheMaximumIsPlusInfinity) {
  TestWorld world(room());
  world.spawn(lidar_post(kRay, "ray", 3, 0.0, "", "<min>0.1</min><max>4</max>"), "post",
              kOneMetreUp);
  world.run(0.025);
  EXPECT_EQ(world.recorder().on<LidarReading>("/scan").front().ranges_m[1],
            std::numeric_limits<float>::infinity());
}

/// Returns times of the first scan of a post with 1081 beams over 270 degrees at 40 Hz.
std::pair<double, double> times_of(std::string post, double step_s = 0.001) {
  TestWorld world("", step_s);
  world.spawn(post, "post");
  world.run(0.05);
  const LidarReading scan = world.recorder().on<LidarReading>("/scan").front();
  return {scan.scan_time_s, scan.time_increment_s};
}

TEST(Lidar, TellsItsTimesAsATurningDeviceDoes) {
  const auto [scan_s, increment_s] = times_of(lidar_post(kRay, "ray", 1081));
  EXPECT_NEAR(scan_s, 0.025, 1e-12);
  EXPECT_NEAR(increment_s, 0.025 / 1440.0, 1e-10);  // a quarter of a degree of a turn
  EXPECT_EQ(times_of(lidar_post(kRay, "ray", 1)).second, 0.0);
  const std::string key = "<timeIncrement>2e-5</timeIncrement>";
  EXPECT_EQ(times_of(lidar_post(kGpu, "gpu_ray", 1081, 0.0, key)).second, 2e-5);
}

TEST(Lidar, WithoutARateScansOnceAStep) {
  std::string post = lidar_post(kRay, "ray", 5);
  const std::string rate = "<update_rate>40</update_rate>";
  EXPECT_NEAR(times_of(post.erase(post.find(rate), rate.size()), 0.005).first, 0.005, 1e-12);
}

TEST(Lidar, ABackwardScanHasANegativeIncrement) {
  std::string post = lidar_post(kRay, "ray", 5);
  post.replace(post.find("-2.35619449"), 11, "1.57079633");
  post.replace(post.find("2.35619449"), 10, "-1.5707963");
  TestWorld world(static_box("left", "0 2.5 0 0 0 0", "1 1 1"));
  world.spawn(post, "post");
  world.run(0.025);
  const LidarReading scan = world.recorder().on<LidarReading>("/scan").front();
  EXPECT_LT(scan.angle_increment_rad, 0.0);
  EXPECT_GT(scan.time_increment_s, 0.0);
  EXPECT_NEAR(scan.ranges_m[0], 2.0, 1e-5);  // the first beam points left
}

// See thesis 4.3.3, Figure 4.14: a plant with visual leaves, and a collision cylinder as its stalk.
TEST(Lidar, CollisionAndVisualLidarsDifferOnALeafAndAgreeOnABox) {
  const std::string plant =
      "<model name='plant'><static>true</static><pose>2 0 0 0 0 0</pose><link name='link'>"
      "<collision "
      "name='stalk'><geometry><cylinder><radius>0.02</radius><length>2</length></cylinder>"
      "</geometry></collision>"
      "<visual name='leaf'><pose>-0.5 0 0 0 0 0</pose><geometry><box><size>0.02 1 0.1</size></box>"
      "</geometry></visual></link></model>" +
      static_box("box", "-3 0 0 0 0 0", "1 1 1");
  for (const auto& [plugin, type, leaf_range] :
       {std::make_tuple(kRay, "ray", 2.0 - 0.02), std::make_tuple(kGpu, "gpu_ray", 1.5 - 0.01)}) {
    TestWorld world(plant);
    std::string post = lidar_post(plugin, type, 3);
    world.spawn(post, "post");
    std::string facing_back =
        lidar_post(plugin, type, 1, 0.0, "<robotNamespace>back</robotNamespace>");
    facing_back.replace(facing_back.find("-2.35619449"), 11, "3.14159265");
    world.spawn(facing_back, "back", Pose::from_xyz_rpy({0, 0, 0}, {0, 0, 0}));
    world.run(0.025);
    EXPECT_NEAR(world.recorder().on<LidarReading>("/scan").front().ranges_m[1], leaf_range, 1e-5);
    EXPECT_NEAR(world.recorder().on<LidarReading>("/back/scan").front().ranges_m[0], 2.5, 1e-5);
  }
}

}  // namespace
}  // namespace ardee
