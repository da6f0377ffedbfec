// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

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

/// Returns a hash of the pictures of a robot that drives far enough to renew its camera's local
/// scene.
std::uint64_t hash_of_pictures(int threads) {
  SimulationOptions options;
  options.rays.threads = threads;
  TestWorld world(ground_plane() + field(40.0), 0.005, options);
  const std::string camera =
      "<link name='camera'/><joint name='camera_joint' type='fixed'><parent link='base'/>"
      "<child link='camera'/><origin xyz='0 0 0.1'/></joint><gazebo reference='camera'>"
      "<sensor type='camera' name='camera'><update_rate>10</update_rate><camera>"
      "<horizontal_fov>1.2</horizontal_fov><image><width>96</width><height>72</height>"
      "<format>R8G8B8</format></image><clip><near>0.05</near><far>50</far></clip></camera>"
      "<plugin name='camera' filename='libgazebo_ros_camera.so'><cameraName>cam</cameraName>"
      "<frameName>camera</frameName></plugin></sensor></gazebo>";
  Entity& robot =
      world.spawn(rover("", camera), "rover", Pose::from_xyz_rpy({-3, 0, 0.151}, {0, 0, 0}));
  world.command(robot, 1.5, 0.0);
  world.run(10.0);
  EXPECT_GT(robot.robot->pose().p.x(), 8.0);
  std::uint64_t hash = 0;
  const auto pictures = world.recorder().on<ImageReading>("/cam/image_raw");
  EXPECT_EQ(pictures.size(), 100u);
  for (const ImageReading& picture : pictures) {
    const auto* bytes = reinterpret_cast<const char*>(picture.data.data());
    hash = mix_bits(hash ^ stream_key(0, {bytes, picture.data.size()}));
  }
  return hash;
}

TEST(Determinism, PicturesOfADriveAreTheSameBytesForAnyThreads) {
  const std::uint64_t reference = hash_of_pictures(1);
  EXPECT_EQ(hash_of_pictures(1), reference);
  EXPECT_EQ(hash_of_pictures(2), reference);
  EXPECT_EQ(hash_of_pictures(5), reference);
}

TEST(Determinism, AnotherSeedGivesOtherBytes) {
  EXPECT_NE(hash_of_run(2, true, 5), hash_of_run(2, true, 6));
}

}  // namespace
}  // namespace ardee
