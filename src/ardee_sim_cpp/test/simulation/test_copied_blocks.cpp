// SPDX-License-Identifier: MIT
// Tests of plugin blocks as users copy them from Gazebo's documentation, with rare but legal
// variants.
#include <gtest/gtest.h>

#include <cmath>

#include "../statistics.h"
#include "cameras.h"
#include "ray_posts.h"

namespace ardee {
using namespace devices;
namespace {

bool any_contains(const std::vector<std::string>& messages, const std::string& part) {
  return std::any_of(messages.begin(), messages.end(), [&](const std::string& message) {
    return message.find(part) != std::string::npos;
  });
}

TEST(CopiedBlocks, NoiseOfALidarWithoutATypeIsGaussian) {
  constexpr double kStd = 0.02;
  RayPost post{"libgazebo_ros_laser.so"};
  post.noise = "<stddev>0.02</stddev>";
  TestWorld world(board("wall", 5.0, 0.0, 6.0), 0.02);
  world.spawn(post.xml(), "post");
  world.run(100.0);
  std::vector<double> errors;
  for (const auto& scan : world.recorder().on<LidarReading>("/seen")) {
    errors.push_back(static_cast<double>(scan.ranges_m[0]) - 5.0);
  }
  ASSERT_EQ(errors.size(), 1000u);
  EXPECT_NEAR(mean_of(errors), 0.0, kFourSigma * kStd / std::sqrt(1000.0));
  EXPECT_NEAR(std_of(errors), kStd, kFourSigma * kStd / std::sqrt(2000.0));
}

TEST(CopiedBlocks, NoiseOfACameraWithoutATypeIsGaussian) {
  constexpr double kStd = 0.05;
  TestWorld world(glowing_box("wall", "2 0 0 0 0 0", "0.1 9 9", 0.5));
  world.spawn(
      camera_post("camera", camera_block(64, 48, 1.0, "<noise><stddev>0.05</stddev></noise>")),
      "post");
  world.run(0.1);
  const auto images = world.recorder().on<ImageReading>("/cam/image_raw");
  ASSERT_EQ(images.size(), 1u);
  std::vector<double> values;
  for (const std::uint8_t value : images[0].data) values.push_back(value / 255.0);
  // Rounding to 1/255 adds a variance of (1/255)^2 / 12.
  EXPECT_NEAR(std_of(values), std::hypot(kStd, 1.0 / 255.0 / std::sqrt(12.0)), 0.003);
}

TEST(CopiedBlocks, AVerticalScanMayReachTheZenithAsItIsWritten) {
  RayPost post{"libgazebo_ros_block_laser.so"};
  post.vertical = "<samples>3</samples><min_angle>-1.5708</min_angle><max_angle>1.5708</max_angle>";
  TestWorld world(static_box("ceiling", "0 0 3.5 0 0 0", "4 4 1"));
  world.spawn(post.xml(), "post");
  world.run(0.1);
  EXPECT_TRUE(world.messages().empty());
  const auto clouds = world.recorder().on<LegacyCloudReading>("/seen");
  ASSERT_EQ(clouds.size(), 1u);
  ASSERT_EQ(clouds[0].points.size(), 3u);
  EXPECT_EQ(clouds[0].points[0].x(), std::numeric_limits<float>::infinity());
  EXPECT_NEAR(clouds[0].points[2].z(), 3.0, 1e-5);
  EXPECT_NEAR(clouds[0].points[2].x(), 3.0 * std::cos(1.5708), 1e-5);
}

std::string camera_named(const std::string& name) {
  return "<sdf version='1.6'><model name='post'><static>true</static><link name='mast'>"
         "<sensor name='eye' type='camera'><update_rate>10</update_rate>" +
         camera_block(8, 6, 1.0) +
         "<plugin name='eye' filename='libgazebo_ros_camera.so'><cameraName>" + name +
         "</cameraName></plugin></sensor></link></model></sdf>";
}

TEST(CopiedBlocks, ACamerasNameIsBelowTheRobotsNamespace) {
  TestWorld world("");
  world.spawn(camera_named("/cam"), "one", {}, "a");
  world.spawn(camera_named("cam"), "two", {}, "b");
  world.spawn(camera_named(""), "three", {}, "/c/d/");
  world.spawn(camera_named("/cam/"), "four");
  world.run(0.1);
  for (const char* topic :
       {"/a/cam/image_raw", "/b/cam/camera_info", "/c/d/image_raw", "/cam/image_raw"}) {
    EXPECT_EQ(world.recorder().count(topic), 1u) << topic;
  }
}

TEST(CopiedBlocks, AnEmptyTopicLeavesTheSensorOut) {
  RayPost post{"libgazebo_ros_laser.so"};
  std::string xml = post.xml();
  const std::string topic = "<topicName>seen</topicName>";
  xml.replace(xml.find(topic), topic.size(), "<topicName></topicName>");
  TestWorld world("");
  EXPECT_TRUE(world.spawn(xml, "post", {}, "robot").devices.empty());
  ASSERT_EQ(world.messages().size(), 1u);
  EXPECT_TRUE(any_contains(world.messages(), "found '' as a topic or service, expected a name"));
}

TEST(CopiedBlocks, AnImuWithoutAServiceHasNone) {
  TestWorld world("");
  const Entity& robot = world.spawn(
      "<sdf version='1.6'><model name='post'><link name='mast'/><plugin name='imu' "
      "filename='libgazebo_ros_imu.so'><bodyName>mast</bodyName><serviceName></serviceName>"
      "</plugin></model></sdf>",
      "post");
  ASSERT_EQ(robot.devices.size(), 1u);
  EXPECT_TRUE(robot.devices[0]->ports().all<Service>().empty());
}

TEST(CopiedBlocks, APluginInTheWrongPlaceIsToldTheRightOne) {
  const auto message = [](const std::string& body) {
    TestWorld world("");
    world.spawn(
        "<sdf version='1.6'><model name='post'><static>true</static>" + body + "</model></sdf>",
        "post");
    EXPECT_EQ(world.messages().size(), 1u);
    return world.messages().at(0);
  };
  const std::string laser =
      message("<link name='mast'/><plugin name='p' filename='libgazebo_ros_laser.so'></plugin>");
  EXPECT_NE(laser.find("found plugin 'libgazebo_ros_laser.so', expected it within a <sensor>"),
            std::string::npos)
      << laser;
  const std::string imu = message(
      "<link name='mast'><sensor name='s' type='imu'><plugin name='p' "
      "filename='libgazebo_ros_imu.so'></plugin></sensor></link>");
  EXPECT_NE(imu.find("found plugin 'libgazebo_ros_imu.so', expected it outside of <sensor>"),
            std::string::npos)
      << imu;
}

}  // namespace
}  // namespace ardee
