// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "ardee_sim/core/rng.h"
#include "fixture.h"
#include "rover.h"

namespace ardee {
using namespace devices;
namespace {

/// Returns a field of boards at all angles, 20 a metre: dense enough for rays to graze edges.
std::string field(double length_m = 6.0) {
  std::string models;
  const CounterRng rng(stream_key(1, "field"));
  for (int i = 0; i < 20 * length_m; ++i) {
    const double x = -2.0 + length_m * rng.uniform(3 * i);
    const double y = (i % 2 ? 0.5 : -0.5) + 0.3 * (rng.uniform(3 * i + 1) - 0.5);
    models +=
        "<model name='b" + std::to_string(i) + "'><static>true</static><pose>" + std::to_string(x) +
        " " + std::to_string(y) + " 0.2 0.3 0.4 " + std::to_string(6.28 * rng.uniform(3 * i + 2)) +
        "</pose><link name='l'><collision name='c'><geometry><cylinder><radius>0.01</radius>"
        "<length>0.4</length></cylinder></geometry></collision><visual name='v'><geometry><box>"
        "<size>0.3 0.01 0.4</size></box></geometry></visual></link></model>";
  }
  return models;
}

std::uint64_t hash_of_run(int threads, bool flatten, std::uint64_t seed) {
  SimulationOptions options;
  options.seed = seed;
  options.rays.threads = threads;
  options.rays.local_scenes = flatten;
  TestWorld world(ground_plane() + field(), 0.005, options);
  const std::string lidar =
      "<link name='lidar'/><joint name='lidar_joint' type='fixed'><parent link='base'/>"
      "<child link='lidar'/><origin xyz='0 0 0.1'/></joint><gazebo reference='lidar'>"
      "<sensor type='gpu_ray' name='lidar'><update_rate>40</update_rate><ray><scan><horizontal>"
      "<samples>1081</samples><min_angle>-2.35</min_angle><max_angle>2.35</max_angle></"
      "horizontal></scan>"
      "<range><min>0.06</min><max>10</max></range><noise><type>gaussian</type><stddev>0.01</stddev>"
      "</noise></ray><plugin name='lidar' "
      "filename='libgazebo_ros_gpu_laser.so'><topicName>scan</topicName>"
      "<frameName>lidar</frameName></plugin></sensor></gazebo>";
  Entity& robot =
      world.spawn(rover("", lidar), "rover", Pose::from_xyz_rpy({-3, 0, 0.151}, {0, 0, 0}));
  world.command(robot, 0.4, 0.1);
  world.run(5.0);  // 1000 steps
  std::uint64_t hash = 0;
  const auto add = [&hash](const void* data, std::size_t size) {
    hash = mix_bits(hash ^ stream_key(0, {static_cast<const char*>(data), size}));
  };
  for (const LidarReading& scan : world.recorder().on<LidarReading>("/scan")) {
    add(scan.ranges_m.data(), scan.ranges_m.size() * sizeof(float));
    add(scan.intensities.data(), scan.intensities.size() * sizeof(float));
  }
  for (const OdometryReading& odometry : world.recorder().on<OdometryReading>("/odom")) {
    add(odometry.pose.p.data(), 3 * sizeof(double));
    add(odometry.twist.linear.data(), 3 * sizeof(double));
  }
  return hash;
}

TEST(Determinism, SameBytesForAnyThreadsAndForTilesAndInstances) {
  const std::uint64_t reference = hash_of_run(1, true, 5);
  EXPECT_EQ(hash_of_run(1, true, 5), reference);
  EXPECT_EQ(hash_of_run(2, true, 5), reference);
  EXPECT_EQ(hash_of_run(8, true, 5), reference);
  EXPECT_EQ(hash_of_run(2, false, 5), reference);
}

std::string camera_on_base() {
  return "<link name='camera'/><joint name='camera_joint' type='fixed'><parent link='base'/>"
         "<child link='camera'/><origin xyz='0 0 0.1'/></joint><gazebo reference='camera'>"
         "<sensor type='camera' name='camera'><update_rate>10</update_rate><camera>"
         "<horizontal_fov>1.2</horizontal_fov><image><width>96</width><height>72</height>"
         "<format>R8G8B8</format></image><clip><near>0.05</near><far>50</far></clip></camera>"
         "<plugin name='camera' filename='libgazebo_ros_camera.so'><cameraName>cam</cameraName>"
         "<frameName>camera</frameName></plugin></sensor></gazebo>";
}

/// A robot with a camera before a field so wide that its camera renews its local scene on the way,
/// or so narrow that all of it is in one.
struct CameraDrive {
  TestWorld world;
  Entity& robot;

  explicit CameraDrive(double field_m, const SimulationOptions& options = {})
      : world(ground_plane() + field(field_m), 0.005, options),
        robot(world.spawn(rover("", camera_on_base()), "rover",
                          Pose::from_xyz_rpy({-3, 0, 0.151}, {0, 0, 0}))) {}

  /// Drives on, and returns a hash of the pictures on the way.
  std::uint64_t hash_of_pictures(double duration_s) {
    world.command(robot, 1.5, 0.0);
    world.recorder().clear();
    world.run(duration_s);
    std::uint64_t hash = 0;
    const auto pictures = world.recorder().on<ImageReading>("/cam/image_raw");
    EXPECT_EQ(pictures.size(), static_cast<std::size_t>(std::lround(10.0 * duration_s)));
    for (const ImageReading& picture : pictures) {
      const auto* bytes = reinterpret_cast<const char*>(picture.data.data());
      hash = mix_bits(hash ^ stream_key(0, {bytes, picture.data.size()}));
    }
    return hash;
  }
};

TEST(Determinism, PicturesOfADriveAreTheSameBytesForAnyThreads) {
  const auto hash_with = [](int threads) {
    SimulationOptions options;
    options.rays.threads = threads;
    CameraDrive drive(40.0, options);
    const std::uint64_t hash = drive.hash_of_pictures(10.0);
    EXPECT_GT(drive.robot.robot->pose().p.x(), 8.0);
    return hash;
  };
  const std::uint64_t reference = hash_with(1);
  EXPECT_EQ(hash_with(1), reference);
  EXPECT_EQ(hash_with(2), reference);
  EXPECT_EQ(hash_with(5), reference);
}

class PicturesAgain : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(FieldsOf, PicturesAgain, testing::Values(40.0, 20.0));

TEST_P(PicturesAgain, AreTheSameBytesAfterAResetAndFromARestoredMoment) {
  CameraDrive drive(GetParam());
  const SimulationState begin = drive.world->save();
  const std::uint64_t first = drive.hash_of_pictures(5.0);
  const SimulationState middle = drive.world->save();
  const std::uint64_t second = drive.hash_of_pictures(5.0);
  drive.world->restore(middle);
  EXPECT_EQ(drive.hash_of_pictures(5.0), second);
  drive.world->restore(begin);
  EXPECT_EQ(drive.hash_of_pictures(5.0), first);
  EXPECT_EQ(drive.hash_of_pictures(5.0), second);
  drive.world->reset_simulation();
  EXPECT_EQ(drive.hash_of_pictures(5.0), first);
}

TEST(Determinism, AnotherSeedGivesOtherBytes) {
  EXPECT_NE(hash_of_run(2, true, 5), hash_of_run(2, true, 6));
}

}  // namespace
}  // namespace ardee
