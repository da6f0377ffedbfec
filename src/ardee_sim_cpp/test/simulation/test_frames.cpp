// SPDX-License-Identifier: MIT
// Tests of the prefix of frames in readings: a given one, the robot's namespace, or nothing; and of
// the velocities in the odometry of a robot that is not level.
#include <gtest/gtest.h>

#include <cmath>

#include "all_devices.h"
#include "fixture.h"

namespace ardee {
using namespace devices;
namespace {

using Frames = std::map<std::string, std::string>;

/// Frame of the latest reading, by topic.
class FramesByTopic : public ReadingSink {
 public:
  void on_reading(const Output& output, const Reading& reading) override {
    frames_[output.topic] =
        std::visit([](const auto& each) { return each.header.frame_id; }, reading);
  }
  const Frames& frames() const { return frames_; }

 private:
  Frames frames_;
};

/// Returns the frames of a robot in the namespace r1.
Frames frames_with(const std::string& prefix) {
  const auto sensor = [](const std::string& library, const std::string& type,
                         const std::string& block, const std::string& name) {
    return mast_sensor(library, type, block,
                       "<frameName>nose</frameName><topicName>" + name +
                           "</topicName><cameraName>" + name + "</cameraName>");
  };
  const std::string wheels =
      "<leftJoint>fl_joint</leftJoint><rightJoint>fr_joint</rightJoint>"
      "<leftFrontJoint>fl_joint</leftFrontJoint><rightFrontJoint>fr_joint</rightFrontJoint>"
      "<leftRearJoint>rl_joint</leftRearJoint><rightRearJoint>rr_joint</rightRearJoint>";
  const auto drive = [&wheels](const std::string& library, const std::string& topic) {
    return model_device(library, wheels + "<odometryFrame>odom</odometryFrame><odometryTopic>" +
                                     topic + "</odometryTopic>");
  };
  SimulationOptions options;
  options.frame_prefix = [prefix](const std::string&) { return prefix; };
  TestWorld world(ground_plane(), 0.005, options);
  world.spawn(rover_with({drive("gazebo_ros_diff_drive", "diff"),
                          drive("gazebo_ros_skid_steer_drive", "skid"),
                          drive("gazebo_ros_planar_move", "planar"),
                          sensor("gazebo_ros_laser", "ray", noisy_rays(), "laser"),
                          sensor("gazebo_ros_gpu_laser", "gpu_ray", noisy_rays(), "gpu_laser"),
                          sensor("gazebo_ros_block_laser", "ray", noisy_rays(), "block"),
                          sensor("gazebo_ros_range", "ray", noisy_rays(), "range"),
                          sensor("gazebo_ros_camera", "camera", noisy_eye(), "camera")}),
              "rover", Pose::from_xyz_rpy({0, 0, 0.151}, {0, 0, 0}), "r1");
  FramesByTopic given;
  world->set_sink(&given);
  world.run(0.3);
  Frames frames = given.frames();
  frames.erase("/tf");
  return frames;
}

TEST(Frames, HaveTheNamespaceInFrontWhereTheStockPluginsPutIt) {
  EXPECT_EQ(frames_with(""), (Frames{{"/r1/diff", "r1/odom"},
                                     {"/r1/skid", "odom"},
                                     {"/r1/planar", "odom"},
                                     {"/r1/laser", "r1/nose"},
                                     {"/r1/gpu_laser", "r1/nose"},
                                     {"/r1/block", "nose"},
                                     {"/r1/range", "nose"},
                                     {"/r1/camera/image_raw", "r1/nose"},
                                     {"/r1/camera/camera_info", "r1/nose"}}));
}

TEST(Frames, HaveThePrefixInFrontWhereThereIsOne) {
  for (const auto& [topic, frame] : frames_with("p")) EXPECT_EQ(frame.substr(0, 2), "p/") << topic;
}

TEST(PlanarTwist, IsWhatIsSeenFromAbove) {
  // The robot heads north, rolled and pitched; it moves north, a little east, and up.
  TestWorld world("");
  const double north = M_PI / 2;
  Entity& rover =
      world.spawn(rover_with({}), "rover", Pose::from_xyz_rpy({0, 0, 9}, {0.4, -0.3, north}));
  rover.robot->dynamics().set_twist({{0.5, 3.0, 1.0}, {0.1, 0.2, 0.7}});
  const Twist seen = rover.robot->planar_twist();
  EXPECT_NEAR((seen.linear - Eigen::Vector3d(3.0, -0.5, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((seen.angular - Eigen::Vector3d(0.0, 0.0, 0.7)).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace ardee
