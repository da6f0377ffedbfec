// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "cameras.h"

namespace ardee {
using namespace devices;
namespace {

constexpr double kWall_m = 3.0;

std::string eye(const std::string& name, const std::string& type, const std::string& format) {
  return "<sensor name='" + name + "' type='" + type +
         "'><update_rate>30</update_rate><camera><horizontal_fov>1</horizontal_fov><image><width>16"
         "</width><height>12</height><format>" +
         format + "</format></image><clip><near>0.05</near><far>50</far></clip></camera></sensor>";
}

std::string eyes(const std::string& depth) {
  return eye("d435_color", "camera", "R8G8B8") + eye("d435_ired1", "camera", "L8") +
         eye("d435_ired2", "camera", "L8") + eye("d435_" + depth, "depth", "R8G8B8");
}

std::string plugin(const std::string& keys) {
  return "<plugin name='camera' filename='librealsense_gazebo_plugin.so'><prefix>d435_</prefix>" +
         keys + "</plugin>";
}

/// Returns a device on a mast that looks at a wall; `keys` go into its plugin.
std::string device(const std::string& keys, const std::string& depth = "depth") {
  return "<sdf version='1.6'><model name='post'><static>true</static><link name='mast'>" +
         eyes(depth) + "</link>" + plugin(keys) + "</model></sdf>";
}

std::string device_in_urdf() {
  return "<robot name='post'><link name='mast'/><gazebo><static>true</static></gazebo>"
         "<gazebo reference='mast'>" +
         eyes("depth") + "</gazebo><gazebo>" + plugin("") + "</gazebo></robot>";
}

struct Realsense {
  explicit Realsense(const std::string& model, const std::string& robot_namespace = "")
      : world(static_box("wall", "3.5 0 0 0 0 0", "1 40 40")) {
    world.spawn(model, "post", {}, robot_namespace);
    world.run(1.0);
  }
  std::vector<ImageReading> images(const std::string& topic) const {
    return world.recorder().on<ImageReading>(topic);
  }
  TestWorld world;
};

TEST(Realsense, ItsFourCamerasPublish) {
  // The keys are those of the device's published macro.
  const Realsense d435(
      device("<depthUpdateRate>10</depthUpdateRate><colorUpdateRate>5</colorUpdateRate>"
             "<infraredUpdateRate>1</infraredUpdateRate><depthTopicName>depth/image_raw"
             "</depthTopicName><depthCameraInfoTopicName>depth/info</depthCameraInfoTopicName>"
             "<colorTopicName>rgb/image_raw</colorTopicName><colorCameraInfoTopicName>rgb/info"
             "</colorCameraInfoTopicName><infrared1TopicName>ir/image_raw</infrared1TopicName>"
             "<infrared2TopicName>ir2/image_raw</infrared2TopicName><colorOpticalframeName>"
             "color_optical</colorOpticalframeName><depthOpticalframeName>depth_optical"
             "</depthOpticalframeName><rangeMinDepth>0.3</rangeMinDepth><rangeMaxDepth>10"
             "</rangeMaxDepth><pointCloud>true</pointCloud><pointCloudTopicName>cloud"
             "</pointCloudTopicName><pointCloudCutoff>0.3</pointCloudCutoff>"),
      "robot");
  const auto color = d435.images("/robot/camera/rgb/image_raw");
  ASSERT_EQ(color.size(), 5u);
  EXPECT_EQ(color[0].encoding, "rgb8");
  EXPECT_EQ(color[0].header.frame_id, "color_optical");
  EXPECT_EQ(d435.world.recorder().count("/robot/camera/rgb/info"), 5u);
  for (const char* topic : {"/robot/camera/ir/image_raw", "/robot/camera/ir2/image_raw"}) {
    const auto infrared = d435.images(topic);
    ASSERT_EQ(infrared.size(), 1u);
    EXPECT_EQ(infrared[0].encoding, "mono8");
  }
  const auto depth = d435.images("/robot/camera/depth/image_raw");
  ASSERT_EQ(depth.size(), 10u);
  EXPECT_EQ(depth[0].encoding, "16UC1");
  EXPECT_EQ(depth[0].header.frame_id, "depth_optical");
  ASSERT_EQ(depth[0].data.size(), 2u * 16 * 12);
  for (std::size_t i = 0; i < depth[0].data.size(); i += 2) {
    ASSERT_NEAR(value_at<std::uint16_t>(depth[0].data, i), 1000.0 * kWall_m, 1.0);
  }
  EXPECT_EQ(d435.world.recorder().count("/robot/camera/depth/info"), 10u);
  EXPECT_EQ(d435.world.recorder().count("/robot/camera/cloud"), 10u);
  EXPECT_TRUE(d435.world.messages().empty());
}

TEST(Realsense, WithoutKeysItHasItsDriversTopics) {
  for (const std::string& model : {device(""), device_in_urdf()}) {
    const Realsense d435(model);
    for (const std::string name : {"color", "infra1", "infra2", "depth"}) {
      EXPECT_EQ(d435.images("/camera/" + name + "/image_raw").size(), 30u) << name;
      EXPECT_EQ(d435.world.recorder().count("/camera/" + name + "/camera_info"), 30u) << name;
    }
    const auto infrared = d435.images("/camera/infra1/image_raw");
    ASSERT_FALSE(infrared.empty());
    EXPECT_EQ(infrared[0].header.frame_id, "d435_ired1");
    EXPECT_TRUE(d435.world.messages().empty());
  }
}

TEST(Realsense, ItsRangeBoundsItsDepth) {
  const Realsense blind(device("<rangeMaxDepth>2.9</rangeMaxDepth>"));
  const auto depth = blind.images("/camera/depth/image_raw");
  ASSERT_FALSE(depth.empty());
  EXPECT_TRUE(std::all_of(depth[0].data.begin(), depth[0].data.end(),
                          [](std::uint8_t byte) { return byte == 0; }));
}

bool says(const Realsense& device, const std::string& text) {
  const auto& messages = device.world.messages();
  return std::any_of(messages.begin(), messages.end(), [&](const std::string& message) {
    return message.find(text) != std::string::npos;
  });
}

TEST(Realsense, SaysWhatItDoesNotDo) {
  const Realsense without_depth(device("", "z"));
  EXPECT_TRUE(says(without_depth, "expected 'd435_depth'; it is left out"));
  EXPECT_FALSE(without_depth.images("/camera/color/image_raw").empty());
  EXPECT_TRUE(says(Realsense(device("<colorTopic>a</colorTopic>")), "colorTopic"));
  EXPECT_TRUE(says(Realsense(device("<pointCloudCutoff>0.5</pointCloudCutoff>")),
                   "found more than <rangeMinDepth>"));
  const Realsense bad(device("<colorUpdateRate>fast</colorUpdateRate>"));
  EXPECT_TRUE(says(bad, "<colorUpdateRate>: found 'fast', expected a finite number"));
  EXPECT_TRUE(bad.images("/camera/color/image_raw").empty());
  EXPECT_FALSE(bad.images("/camera/depth/image_raw").empty());
}

}  // namespace
}  // namespace ardee
