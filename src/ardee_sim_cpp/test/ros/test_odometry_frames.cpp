// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "ros/odometry_frames.h"

namespace ardee::node {
using namespace devices;
namespace {

/// Robot at (3, 1), turned to the left, with the latest transforms of /tf_static.
struct Scene {
  Scene() { robot.place(Pose::from_xyz_rpy({3, 1, 0.2}, {0, 0, M_PI / 2})); }

  std::map<std::string, geometry_msgs::Transform> told;  // by child frame
  OdometryFrames frames{[this](const tf2_msgs::TFMessage& message) {
    told.clear();
    for (const auto& each : message.transforms) {
      EXPECT_EQ(each.header.frame_id, "world");
      told[each.child_frame_id] = each.transform;
    }
  }};
  Robot robot{"robot", std::make_shared<Model>(), 0};
};

/// Returns a drive's transform of the robot's base.
TransformReading odometry(const std::string& frame, const Pose& X_OB) {
  return {{0, frame}, "base", X_OB, true};
}

TEST(OdometryFrames, LieWhereTheWheelsStartedToCount) {
  Scene scene;
  scene.frames.on_reading(scene.robot, odometry("odom", {}));
  ASSERT_EQ(scene.told.size(), 1u);
  const geometry_msgs::Transform& X_WO = scene.told.at("odom");
  EXPECT_NEAR(X_WO.translation.x, 3.0, 1e-12);
  EXPECT_NEAR(X_WO.translation.y, 1.0, 1e-12);
  EXPECT_NEAR(X_WO.translation.z, 0.2, 1e-12);
  EXPECT_NEAR(X_WO.rotation.z, std::sqrt(0.5), 1e-12);
}

TEST(OdometryFrames, AreTheWorldWhereOdometryIsThePoseInTheWorld) {
  Scene scene;
  scene.frames.on_reading(scene.robot, odometry("odom", scene.robot.pose()));
  EXPECT_EQ(scene.told.at("odom").translation.x, 0.0);
  EXPECT_EQ(scene.told.at("odom").rotation.w, 1.0);
}

TEST(OdometryFrames, ComeFromMessagesTooWhoseHeightIsNone) {
  Scene scene;
  OdometryReading reading;
  reading.header.frame_id = "odom";
  scene.frames.on_reading(scene.robot, reading);
  EXPECT_NEAR(scene.told.at("odom").translation.y, 1.0, 1e-12);
  EXPECT_EQ(scene.told.at("odom").translation.z, 0.0);
}

TEST(OdometryFrames, AreNotTheLinksThatCarryWheels) {
  // <publishWheelTF> gives each wheel in the chassis, which has its place in the tree.
  Scene scene;
  scene.frames.on_reading(scene.robot, TransformReading{{0, "chassis"}, "wheel", {}});
  EXPECT_TRUE(scene.told.empty());
  OdometryReading truth;
  truth.header.frame_id = "chassis";
  truth.in_odometry_frame = false;
  scene.frames.on_reading(scene.robot, truth);
  EXPECT_TRUE(scene.told.empty());
}

TEST(OdometryFrames, StayAsFirstLearntUntilTheRobotGoesOrIsReset) {
  Scene scene;
  scene.frames.on_reading(scene.robot, odometry("odom", {}));
  scene.robot.place({});
  scene.frames.on_reading(scene.robot, odometry("odom", {}));
  EXPECT_NEAR(scene.told.at("odom").translation.x, 3.0, 1e-12);
  scene.frames.restart();
  scene.frames.on_reading(scene.robot, odometry("odom", {}));
  EXPECT_EQ(scene.told.at("odom").translation.x, 0.0);
  scene.frames.forget("another");
  EXPECT_EQ(scene.told.size(), 1u);
  scene.frames.forget("robot");
  EXPECT_TRUE(scene.told.empty());
}

}  // namespace
}  // namespace ardee::node
