// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "cameras.h"

namespace ardee {
using namespace devices;
namespace {

constexpr int kWidth = 80, kHeight = 60;
constexpr double kWall_m = 3.0;

std::string wall() { return static_box("wall", "3.5 0 0 0 0 0", "1 40 40"); }

struct Kinect {
  explicit Kinect(const std::string& keys = "", const Pose& pose = {},
                  const std::string& plugin = "openni_kinect")
      : world(wall()) {
    world.spawn(camera_post(plugin, camera_block(kWidth, kHeight, 1.0), keys, "depth"), "post",
                pose);
    world.run(0.1);
  }
  ImageReading depth() { return world.recorder().on<ImageReading>("/cam/depth/image_raw").at(0); }
  PointCloudReading cloud() { return world.recorder().on<PointCloudReading>("/cam/points").at(0); }
  TestWorld world;
};

TEST(DepthCamera, MeasuresAlongItsAxis) {
  for (const char* plugin : {"openni_kinect", "depth_camera"}) {
    Kinect kinect("", {}, plugin);
    const ImageReading image = kinect.depth();
    EXPECT_EQ(image.encoding, "32FC1");
    EXPECT_EQ(image.header.frame_id, "optical");
    ASSERT_EQ(image.data.size(), 4u * kWidth * kHeight);
    for (std::size_t i = 0; i < image.data.size(); i += 4) {
      ASSERT_NEAR(value_at<float>(image.data, i), kWall_m, 2e-6);
    }
  }
}

TEST(DepthCamera, ItsCloudLiesOnTheWallThatItSeesAskew) {
  constexpr double kYaw = 0.4, kPitch = -0.2;
  const Pose pose = Pose::from_xyz_rpy({0, 0, 0}, {0, kPitch, kYaw});
  Kinect kinect("", pose);
  const PointCloudReading cloud = kinect.cloud();
  ASSERT_EQ(cloud.point_step, 32u);
  ASSERT_EQ(cloud.width, 1u * kWidth);
  ASSERT_EQ(cloud.height, 1u * kHeight);
  EXPECT_FALSE(cloud.is_dense);
  ASSERT_EQ(cloud.fields.size(), 4u);
  EXPECT_EQ(cloud.fields[3].name, "rgb");
  EXPECT_EQ(cloud.fields[3].offset, 16u);
  const ImageReading depth = kinect.depth();
  for (std::size_t i = 0; i < 1u * kWidth * kHeight; ++i) {
    const auto at = [&](std::size_t k) {
      return static_cast<double>(value_at<float>(cloud.data, 32 * i + 4 * k));
    };
    const Eigen::Vector3d point_C(at(2), -at(0), -at(1));  // from optical axes
    ASSERT_NEAR((pose * point_C).x(), kWall_m, 1e-5);
    ASSERT_EQ(static_cast<float>(at(2)), value_at<float>(depth.data, 4 * i));
  }
}

TEST(DepthCamera, NoiseGrowsAsItsParametersSay) {
  Kinect kinect(
      "<depthNoiseConstant>0.001</depthNoiseConstant><depthNoiseLinear>0.002</depthNoiseLinear>"
      "<depthNoiseQuadratic>0.0005</depthNoiseQuadratic>");
  const double std = 0.001 + 0.002 * kWall_m + 0.0005 * kWall_m * kWall_m;
  const ImageReading image = kinect.depth();
  double sum = 0.0, squares = 0.0;
  const double n = kWidth * kHeight;
  for (std::size_t i = 0; i < image.data.size(); i += 4) {
    const double error = static_cast<double>(value_at<float>(image.data, i)) - kWall_m;
    sum += error;
    squares += error * error;
  }
  // The bound is four standard errors.
  EXPECT_NEAR(sum / n, 0.0, 4.0 * std / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), std, 4.0 * std / std::sqrt(2.0 * n));
}

TEST(DepthCamera, MillimetresAndCutOffs) {
  Kinect whole("<useDepth16UC1Format>true</useDepth16UC1Format>");
  const ImageReading image = whole.depth();
  EXPECT_EQ(image.encoding, "16UC1");
  EXPECT_EQ(value_at<std::uint16_t>(image.data, 0), 3000);
  Kinect cut_m("<pointCloudCutoffMax>2.5</pointCloudCutoffMax>");
  EXPECT_TRUE(std::isnan(value_at<float>(cut_m.depth().data, 0)));
  EXPECT_TRUE(std::isnan(value_at<float>(cut_m.cloud().data, 0)));
  Kinect cut_mm(
      "<pointCloudCutoff>3.5</pointCloudCutoff>"
      "<useDepth16UC1Format>true</useDepth16UC1Format>");
  EXPECT_EQ(value_at<std::uint16_t>(cut_mm.depth().data, 0), 0);
}

/// A wall of one colour glows: a pixel's value is its luma by ITU-R BT.601, in closed form.
TEST(DepthCamera, AnInfraredImageIsGreyWhileTheCloudHasColours) {
  const std::string glow =
      "<model name='wall'><static>true</static><pose>3.5 0 0 0 0 0</pose><link name='link'><visual "
      "name='v'><geometry><box><size>1 40 40</size></box></geometry><material><ambient>0 0 0 1"
      "</ambient><diffuse>0 0 0 1</diffuse><emissive>0.2 0.4 0.6 1</emissive></material></visual>"
      "</link></model>";
  constexpr double kLuma = 0.299 * 0.2 + 0.587 * 0.4 + 0.114 * 0.6;
  struct Expected {
    const char* encoding;
    std::uint32_t bytes;
    double value;
  };
  for (const Expected& each : {Expected{"mono8", 1, 255 * kLuma},
                               {"16UC1", 2, 65535 * kLuma},
                               {"mono16", 2, 65535 * kLuma}}) {
    for (const bool image_asked_for : {true, false}) {
      TestWorld world(glow);
      const std::string key = std::string("<imageEncoding>") + each.encoding + "</imageEncoding>";
      Entity& post = world.spawn(
          camera_post("openni_kinect", camera_block(kWidth, kHeight, 1.0), key, "depth"), "post");
      if (!image_asked_for) listen_to(post, {"/cam/points"});
      world.run(0.1);
      const auto cloud = world.recorder().on<PointCloudReading>("/cam/points").at(0);
      EXPECT_EQ(value_at<std::uint32_t>(cloud.data, 16), 0x336699u);  // 51, 102, 153
      if (!image_asked_for) continue;
      const auto image = world.recorder().on<ImageReading>("/cam/ir/image_raw").at(0);
      EXPECT_EQ(image.encoding, each.encoding);
      EXPECT_EQ(image.step, each.bytes * kWidth);
      ASSERT_EQ(image.data.size(), each.bytes * kWidth * kHeight);
      const double value = each.bytes == 1 ? image.data[0] : value_at<std::uint16_t>(image.data, 0);
      EXPECT_NEAR(value, each.value, 0.5 + 1e-4 * each.value);
    }
  }
}

TEST(DepthCamera, AnUnknownEncodingLeavesItOut) {
  TestWorld world(wall());
  Entity& post = world.spawn(camera_post("openni_kinect", camera_block(kWidth, kHeight, 1.0),
                                         "<imageEncoding>L8</imageEncoding>", "depth"),
                             "post");
  EXPECT_TRUE(post.devices.empty());
  ASSERT_EQ(world.messages().size(), 1u);
  EXPECT_NE(world.messages()[0].find("found encoding 'L8', expected one of: "), std::string::npos);
}

TEST(DepthCamera, TheSkyHasNoDepth) {
  Kinect kinect("", Pose::from_xyz_rpy({0, 0, 0}, {0, 0, M_PI}));
  EXPECT_TRUE(std::isnan(value_at<float>(kinect.depth().data, 0)));
}

TEST(DepthCamera, TopicsAndInfos) {
  Kinect kinect;
  Entity& post = *kinect.world->find("post");
  std::vector<std::string> topics;
  for (const Output& output : post.devices.at(0)->ports().all<Output>())
    topics.push_back(output.topic);
  EXPECT_EQ(topics, (std::vector<std::string>{"/cam/ir/image_raw", "/cam/ir/camera_info",
                                              "/cam/depth/image_raw", "/cam/depth/camera_info",
                                              "/cam/points"}));
  for (const char* topic : {"/cam/ir/camera_info", "/cam/depth/camera_info"}) {
    EXPECT_EQ(kinect.world.recorder().on<CameraInfoReading>(topic).size(), 1u) << topic;
  }
  EXPECT_EQ(kinect.world.recorder().on<ImageReading>("/cam/ir/image_raw").size(), 1u);
}

}  // namespace
}  // namespace ardee
