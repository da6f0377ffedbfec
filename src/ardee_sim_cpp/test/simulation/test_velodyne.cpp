// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>

#include "ray_posts.h"

namespace ardee {
using namespace devices;
namespace {

constexpr const char* kGpu = "libgazebo_ros_velodyne_gpu_laser.so";
constexpr const char* kRay = "libgazebo_ros_velodyne_laser.so";
constexpr double kSpin_s = 0.1;
const Pose kOneMetreUp = Pose::from_xyz_rpy({0, 0, 1}, {0, 0, 0});

template <typename T>
T at(const PointCloudReading& cloud, std::size_t point, std::size_t offset) {
  T value;
  std::memcpy(&value, cloud.data.data() + point * cloud.point_step + offset, sizeof value);
  return value;
}

Eigen::Vector3d place(const PointCloudReading& cloud, std::size_t point) {
  return {double(at<float>(cloud, point, 0)), double(at<float>(cloud, point, 4)),
          double(at<float>(cloud, point, 8))};
}

RayPost velodyne(const std::string& keys = "") {
  RayPost post{kRay};
  post.horizontal = angles(3, -0.5, 0.5);
  post.vertical = angles(4, -0.3, 0.3);
  post.keys = keys;
  return post;
}

PointCloudReading first_cloud(TestWorld& world, const RayPost& post,
                              const Pose& pose = kOneMetreUp) {
  world.spawn(post.xml(), "post", pose);
  world.run(kSpin_s);
  const auto clouds = world.recorder().on<PointCloudReading>("/seen");
  EXPECT_EQ(clouds.size(), 1u);
  return clouds.at(0);
}

TEST(Velodyne, LaysPointsOutByteForByte) {
  TestWorld world("");
  Loader loader(ResourceLocator::from_environment(), Log());
  SpawnRequest request;
  request.name = "wall";
  request.model = loader.load_model_text(
      "<sdf version='1.6'>" + board("wall", 0.0, 0.0, 6.0) + "</sdf>", "wall.sdf");
  request.X_WM = Pose::from_xyz_rpy({2, 0, 0}, {0, 0, 0});
  request.is_static = true;
  request.label = 7;
  world->spawn(request);
  RayPost post{kRay};
  post.vertical = angles(3, -0.25, 0.25);
  const PointCloudReading cloud = first_cloud(world, post, {});
  EXPECT_EQ(cloud.header.stamp_ns, 100000000);
  EXPECT_EQ(cloud.header.frame_id, "world");
  EXPECT_EQ(cloud.height, 1u);
  ASSERT_EQ(cloud.width, 3u);
  EXPECT_EQ(cloud.point_step, 32u);
  EXPECT_TRUE(cloud.is_dense);
  ASSERT_EQ(cloud.data.size(), 96u);
  using Type = PointCloudReading::Type;
  const std::vector<std::tuple<std::string, std::uint32_t, Type>> expected{
      {"x", 0, Type::kFloat32},     {"y", 4, Type::kFloat32},
      {"z", 8, Type::kFloat32},     {"intensity", 16, Type::kFloat32},
      {"ring", 20, Type::kUint16},  {"label", 24, Type::kUint32},
      {"time", 28, Type::kFloat32}, {"instance", 12, Type::kUint32}};
  ASSERT_EQ(cloud.fields.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_EQ(std::make_tuple(cloud.fields[k].name, cloud.fields[k].offset, cloud.fields[k].type),
              expected[k]);
  }
  // The middle ring hits the wall squarely: x = 2.0f, instance 1, intensity 1.0f, ring 1, label 7,
  // time 0.0f.
  const std::array<std::uint8_t, 32> middle{0, 0, 0,    0x40, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0,
                                            0, 0, 0x80, 0x3F, 1, 0, 0, 0, 7, 0, 0, 0, 0, 0, 0, 0};
  for (std::size_t k = 0; k < middle.size(); ++k) {
    EXPECT_EQ(cloud.data[32 + k], middle[k]) << "byte " << k;
  }
}

TEST(Velodyne, GoesColumnByColumnAndFromTheLowestRingUpInARoom) {
  for (const char* plugin : {kRay, kGpu}) {
    TestWorld world(room());
    RayPost post = velodyne();
    post.plugin = plugin;
    const PointCloudReading cloud = first_cloud(world, post);
    ASSERT_EQ(cloud.width, 12u) << plugin;
    for (std::size_t k = 0; k < 12; ++k) {
      const double azimuth = -0.5 + 0.5 * double(k / 4);
      const double elevation = -0.3 + 0.2 * double(k % 4);
      const double wall_m = 5.0 / std::cos(azimuth);
      const Eigen::Vector3d expected(5.0, wall_m * std::sin(azimuth), wall_m * std::tan(elevation));
      EXPECT_LT((place(cloud, k) - expected).norm(), 3e-6) << "point " << k;
      EXPECT_EQ(at<std::uint16_t>(cloud, k, 20), k % 4);
    }
  }
}

TEST(Velodyne, OrganisedHasAPlaceForEveryBeam) {
  TestWorld world(board("wall", 2.0, 0.0, 1.0));  // half a metre to each side: the middle column
  const PointCloudReading cloud = first_cloud(world, velodyne("<organised>true</organised>"), {});
  EXPECT_EQ(cloud.width, 4u);
  EXPECT_EQ(cloud.height, 3u);
  EXPECT_FALSE(cloud.is_dense);
  ASSERT_EQ(cloud.data.size(), 12u * 32u);
  for (std::size_t k = 0; k < 12; ++k) {
    EXPECT_EQ(at<std::uint16_t>(cloud, k, 20), k % 4);
    if (k / 4 == 1) {
      EXPECT_NEAR(place(cloud, k).x(), 2.0, 1e-6);
    } else {
      EXPECT_TRUE(place(cloud, k).array().isNaN().all()) << "point " << k;
    }
  }
  TestWorld other(board("wall", 2.0, 0.0, 1.0));
  EXPECT_EQ(first_cloud(other, velodyne(), {}).width, 4u) << "unorganised: those that were met";
}

TEST(Velodyne, LeavesOutWhatItsKeysSay) {
  // Ranges of the three columns: 5 / cos(0.5) = 5.70 m, 5 m, 5.70 m; intensities cos(0.5), 1.
  const auto kept = [](const std::string& keys) {
    TestWorld world(room());
    RayPost post = velodyne(keys);
    post.vertical.clear();
    return first_cloud(world, post).width;
  };
  EXPECT_EQ(kept(""), 3u);
  EXPECT_EQ(kept("<min_range>5.5</min_range>"), 2u);
  EXPECT_EQ(kept("<max_range>5.5</max_range>"), 1u);
  EXPECT_EQ(kept("<min_intensity>0.9</min_intensity>"), 1u);
}

/// Returns the cloud of a floating sensor of 181 columns over a full turn, set in motion at 0 s.
PointCloudReading cloud_in_motion(TestWorld& world, const std::string& keys, const Pose& X_WM,
                                  const Twist& twist_W) {
  RayPost post{kGpu, "gpu_ray"};
  post.horizontal = angles(181, -M_PI, M_PI);
  post.keys = keys;
  post.is_static = false;
  Entity& robot = world.spawn(post.xml(), "post", X_WM);
  robot.robot->dynamics().set_twist(twist_W);
  world.run(2.0 * kSpin_s);
  return world.recorder().on<PointCloudReading>("/seen").at(1);
}

const std::string kDistorted =
    "<organised>true</organised><motionDistortion>true</motionDistortion>";

TEST(Velodyne, MotionTowardsAWallBendsIt) {
  // It moves at 2 m/s along x; the beam at azimuth a leaves (pi - a) / 2 pi of a turn before the
  // stamp, when the wall was farther by that much.
  const double speed = 2.0;
  const std::string wall = board("wall", 4.0, 0.0, 40.0);
  TestWorld world(wall);
  const PointCloudReading cloud =
      cloud_in_motion(world, kDistorted, {}, {{speed, 0, 0}, {0, 0, 0}});
  TestWorld still_world(wall);
  const PointCloudReading frozen =
      cloud_in_motion(still_world, "<organised>true</organised>", {}, {{speed, 0, 0}, {0, 0, 0}});
  const double now_m = 4.0 - speed * 2.0 * kSpin_s;
  int met = 0;
  for (std::size_t column = 0; column < 181; ++column) {
    const double azimuth = -M_PI + 2.0 * M_PI * double(column) / 180.0;
    if (std::cos(azimuth) < 0.3) continue;
    const double to_go_s = kSpin_s * (M_PI - azimuth) / (2.0 * M_PI);
    EXPECT_NEAR(place(cloud, column).x(), now_m + speed * to_go_s, 1e-4) << "column " << column;
    EXPECT_NEAR(place(frozen, column).x(), now_m, 1e-4) << "column " << column;
    ++met;
  }
  EXPECT_GT(met, 60);
}

TEST(Velodyne, PointsTellWhenTheyWereTaken) {
  TestWorld world(room());
  const PointCloudReading cloud = cloud_in_motion(world, kDistorted, kOneMetreUp, {});
  for (std::size_t column = 0; column < 181; ++column) {
    EXPECT_NEAR(double(at<float>(cloud, column, 28)), -kSpin_s * double(180 - column) / 180.0, 1e-8)
        << column;
  }
  TestWorld still_world(room());
  const PointCloudReading frozen =
      cloud_in_motion(still_world, "<organised>true</organised>", kOneMetreUp, {});
  for (std::size_t column = 0; column < 181; ++column) EXPECT_EQ(at<float>(frozen, column, 28), 0);
}

TEST(Velodyne, WithoutARateATurnTakesAStep) {
  // A step is as long as a turn elsewhere: the wall is bent in the same way.
  const double speed = 2.0;
  TestWorld world(board("wall", 4.0, 0.0, 40.0), kSpin_s);
  RayPost post{kGpu, "gpu_ray"};
  post.horizontal = angles(181, -M_PI, M_PI);
  post.keys = kDistorted;
  post.rate = "";
  post.is_static = false;
  world.spawn(post.xml(), "post").robot->dynamics().set_twist({{speed, 0, 0}, {0, 0, 0}});
  world.run(2.0 * kSpin_s);
  const PointCloudReading cloud = world.recorder().on<PointCloudReading>("/seen").at(1);
  for (std::size_t column = 60; column <= 120; ++column) {
    const double azimuth = -M_PI + 2.0 * M_PI * double(column) / 180.0;
    const double to_go_s = kSpin_s * (M_PI - azimuth) / (2.0 * M_PI);
    EXPECT_NEAR(place(cloud, column).x(), 4.0 - speed * (2.0 * kSpin_s - to_go_s), 1e-4) << column;
  }
}

TEST(Velodyne, TurningShiftsWhatStandsBesideIt) {
  // It turns at 2 rad/s: the beam at azimuth a hits a body at bearing b with a + yaw(a) = b, where
  // yaw(a) = yaw_now - spin * (pi - a) / 2 pi.
  const double rate = 2.0;
  const double yaw_now = rate * 2.0 * kSpin_s;
  const double bearing = 0.9;
  const std::string post =
      "<model name='pole'><static>true</static><pose>" + std::to_string(3.0 * std::cos(bearing)) +
      " " + std::to_string(3.0 * std::sin(bearing)) +
      " 0 0 0 0</pose><link name='l'><visual name='v'><geometry><cylinder><radius>0.15</radius>"
      "<length>2</length></cylinder></geometry></visual></link></model>";
  TestWorld world(post);
  const PointCloudReading cloud = cloud_in_motion(world, kDistorted, {}, {{0, 0, 0}, {0, 0, rate}});
  Eigen::Vector3d sum(0, 0, 0);
  int met = 0;
  for (std::size_t column = 0; column < 181; ++column) {
    if (!place(cloud, column).allFinite()) continue;
    EXPECT_LE(place(cloud, column).norm(), 3.0);
    EXPECT_GE(place(cloud, column).norm(), 2.85 - 1e-6);
    sum += place(cloud, column).normalized();
    ++met;
  }
  ASSERT_GE(met, 2);
  const double share = rate * kSpin_s / (2.0 * M_PI);
  const double expected = (bearing - yaw_now + M_PI * share) / (1.0 + share);
  EXPECT_NEAR(std::atan2(sum.y(), sum.x()), expected, 1.1 * M_PI / 180.0);  // half the spacing
  EXPECT_GT(std::abs(expected - (bearing - yaw_now)), 3.0 * M_PI / 180.0) << "a visible shift";
}

TEST(Velodyne, DistortedScansDoNotDependOnWhoListensNorOnThreads) {
  const auto last = [](bool listen_always, int threads) {
    SimulationOptions options;
    options.rays.threads = threads;
    TestWorld world(room(), 0.001, options);
    RayPost post{kGpu, "gpu_ray"};
    post.horizontal = angles(181, -M_PI, M_PI);
    post.vertical = angles(4, -0.2, 0.2);
    post.noise = "<type>gaussian</type><stddev>0.02</stddev>";
    post.keys = kDistorted;
    post.is_static = false;
    Entity& robot = world.spawn(post.xml(), "post", kOneMetreUp);
    robot.robot->dynamics().set_twist({{0.5, 0.2, 0}, {0, 0, 1.0}});
    Output& output = robot.devices[0]->ports().all<Output>()[0];
    output.demanded = listen_always;
    world.run(0.45);
    output.demanded = true;
    world.run(kSpin_s);
    return world.recorder().on<PointCloudReading>("/seen").back().data;
  };
  const auto reference = last(true, 1);
  EXPECT_EQ(last(false, 1), reference);
  EXPECT_EQ(last(true, 4), reference);
}

TEST(Velodyne, MeetsItsOwnRobotWhereItIsAndLooksOutOfItsHousing) {
  // The deck is 0.5 m below, beyond the housing about the sensor; the robot moves at 3 m/s.
  RayPost post{kGpu, "gpu_ray"};
  post.horizontal = angles(4, -M_PI, M_PI);
  post.vertical = angles(2, -1.2, -1.0);
  post.keys = kDistorted;
  post.is_static = false;
  std::string xml = post.xml();
  const std::string end = "</model>";
  const auto part = [](const std::string& name, const std::string& pose, const std::string& shape) {
    return "<link name='" + name + "'><gravity>0</gravity><pose>" + pose +
           "</pose><visual name='v'><geometry>" + shape +
           "</geometry></visual></link><joint name='" + name +
           "' type='fixed'><parent>mast</parent><child>" + name + "</child></joint>";
  };
  xml.insert(xml.find(end),
             part("housing", "0 0 0 0 0 0", "<sphere><radius>0.05</radius></sphere>") +
                 part("deck", "0 0 -0.55 0 0 0", "<box><size>2 2 0.1</size></box>"));
  TestWorld world("");
  Entity& robot = world.spawn(xml, "post");
  robot.robot->dynamics().set_twist({{3, 0, 0}, {0, 0, 0}});
  world.run(2.0 * kSpin_s);
  const PointCloudReading cloud = world.recorder().on<PointCloudReading>("/seen").at(1);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(place(cloud, k).z(), -0.5, 1e-4) << k;
}

}  // namespace
}  // namespace ardee
