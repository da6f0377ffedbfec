// SPDX-License-Identifier: MIT
// Tests that newer Gazebo's names of systems and sensors are read as the stock plugins.
#include <map>

#include "fixture.h"

namespace ardee {
namespace {

class GzSystems : public ReadersTest {
 protected:
  using Keys = std::map<std::string, std::string>;

  static Keys keys_of(const PluginDescription& plugin) {
    Keys keys;
    for (const Element& key : plugin.element.children) keys[key.name] = key.text;
    return keys;
  }
  /// Returns a robot of four wheels with a plugin.
  std::shared_ptr<const Model> rover(const std::string& plugin) {
    std::string body = "<link name='base'/>";
    for (const std::string wheel : {"fl", "fr", "rl", "rr"}) {
      body += "<link name='" + wheel + "'/><joint name='" + wheel + "_joint' type='revolute'>" +
              "<parent>base</parent><child>" + wheel + "</child><axis><xyz>0 1 0</xyz><limit>" +
              "<effort>12</effort></limit></axis></joint>";
    }
    return model(body + plugin, "1.9");
  }
  const SensorDescription& sensor(const std::string& text) {
    loaded_ = model("<link name='base'>" + text + "</link>", "1.9");
    return loaded_->links.at(0).sensors.at(0);
  }

  std::shared_ptr<const Model> loaded_;
};

const std::string kDrive =
    "<left_joint>fl_joint</left_joint><right_joint>fr_joint</right_joint>"
    "<wheel_separation>0.4</wheel_separation><wheel_radius>0.1</wheel_radius><topic>go</topic>"
    "<odom_topic>where</odom_topic><frame_id>o</frame_id><child_frame_id>b</child_frame_id>"
    "<odom_publish_frequency>20</odom_publish_frequency>";

TEST_F(GzSystems, ADiffDriveIsTheStockOneUnderEachOfItsNames) {
  for (const std::string file : {"gz-sim-diff-drive-system", "libgz-sim-diff-drive-system.so",
                                 "gz-sim7-diff-drive-system", "ignition-gazebo-diff-drive-system",
                                 "/usr/lib/libignition-gazebo6-diff-drive-system.so.6"}) {
    const auto m = rover("<plugin filename='" + file + "' name='gz::sim::systems::DiffDrive'>" +
                         kDrive + "</plugin>");
    ASSERT_EQ(m->plugins.size(), 1u) << file;
    EXPECT_EQ(m->plugins[0].filename, "libgazebo_ros_diff_drive.so");
    EXPECT_EQ(keys_of(m->plugins[0]), (Keys{{"leftJoint", "fl_joint"},
                                            {"rightJoint", "fr_joint"},
                                            {"wheelSeparation", "0.4"},
                                            {"wheelDiameter", "0.20000000000000001"},
                                            {"wheelTorque", "12"},
                                            {"commandTopic", "go"},
                                            {"odometryTopic", "where"},
                                            {"odometryFrame", "o"},
                                            {"robotBaseFrame", "b"},
                                            {"updateRate", "20"},
                                            {"legacyMode", "false"},
                                            {"odometrySource", "encoder"}}));
  }
}

TEST_F(GzSystems, EachFurtherPairOfWheelsHasADriveThatSaysNothing) {
  const auto m = rover("<plugin filename='gz-sim-diff-drive-system' name='d'>" + kDrive +
                       "<left_joint>rl_joint</left_joint><right_joint>rr_joint</right_joint>"
                       "<max_velocity>1</max_velocity></plugin>");
  ASSERT_EQ(m->plugins.size(), 2u);
  const Keys rear = keys_of(m->plugins[1]);
  EXPECT_EQ(rear.at("leftJoint"), "rl_joint");
  EXPECT_EQ(rear.at("rightJoint"), "rr_joint");
  EXPECT_EQ(rear.at("commandTopic"), "go");
  EXPECT_EQ(rear.at("publishOdom"), "false");
  EXPECT_EQ(rear.at("publishOdomTF"), "false");
  EXPECT_EQ(keys_of(m->plugins[0]).count("publishOdom"), 0u);
  EXPECT_NE(m->plugins[0].name, m->plugins[1].name);
  // A key without counterpart stays, so that the plugin reports it.
  EXPECT_EQ(rear.at("max_velocity"), "1");
  EXPECT_HAS(error_of([&] { rover("<plugin filename='gz-sim-diff-drive-system' name='d'/>"); }),
             "found no <left_joint> or no <right_joint>");
}

TEST_F(GzSystems, OtherSystemsAreTheirCounterparts) {
  const auto publisher = rover("<plugin filename='gz-sim-joint-state-publisher-system' name='p'/>");
  EXPECT_EQ(keys_of(publisher->plugins.at(0)).at("jointName"),
            "fl_joint,fr_joint,rl_joint,rr_joint,");
  const auto two = rover(
      "<plugin filename='gz-sim-joint-state-publisher-system' name='p'>"
      "<joint_name>rl_joint</joint_name><joint_name>fr_joint</joint_name></plugin>");
  EXPECT_EQ(keys_of(two->plugins.at(0)).at("jointName"), "rl_joint,fr_joint,");
  EXPECT_TRUE(warnings_->empty());
  const auto odometry = rover(
      "<plugin filename='gz-sim-odometry-publisher-system' name='o'>"
      "<odom_topic>truth</odom_topic><dimensions>3</dimensions></plugin>");
  EXPECT_EQ(odometry->plugins.at(0).filename, "libgazebo_ros_p3d.so");
  EXPECT_EQ(keys_of(odometry->plugins.at(0)).at("bodyName"), "base");
  EXPECT_EQ(keys_of(odometry->plugins.at(0)).at("topicName"), "truth");
  EXPECT_TRUE(warned("the odometry is that of the true pose in the world"));
  const auto mecanum = rover(
      "<plugin filename='gz-sim-mecanum-drive-system' name='m'>"
      "<front_left_joint>fl_joint</front_left_joint><topic>go</topic></plugin>");
  EXPECT_EQ(keys_of(mecanum->plugins.at(0)),
            (Keys{{"commandTopic", "go"}, {"odometryRate", "50"}}));
  const auto servo = rover(
      "<plugin filename='gz-sim-joint-position-controller-system' name='s'>"
      "<joint_name>fl_joint</joint_name><topic>angle</topic></plugin>");
  EXPECT_EQ(keys_of(servo->plugins.at(0)),
            (Keys{{"joint", "fl_joint"}, {"commandTopic", "angle"}}));
}

TEST_F(GzSystems, WhatHasNoCounterpartIsOneWarning) {
  const auto m = rover(
      "<plugin filename='gz-sim-buoyancy-system' name='b'/>"
      "<plugin filename='gz-sim-thruster-system' name='t'/>");
  EXPECT_TRUE(m->plugins.empty());
  ASSERT_EQ(warnings_->size(), 1u);
  EXPECT_HAS(warnings_->at(0), "'gz-sim-buoyancy-system'; it is left out (and 1 more)");
  const auto stock = rover("<plugin filename='libgazebo_ros_p3d.so' name='p'><a>1</a></plugin>");
  EXPECT_EQ(keys_of(stock->plugins.at(0)), (Keys{{"a", "1"}}));
}

TEST_F(GzSystems, AWorldsOwnSystemsAreNothingToSpeakOf) {
  const World w = world(
      "<plugin filename='gz-sim-physics-system' name='gz::sim::systems::Physics'/>"
      "<plugin filename='libignition-gazebo-sensors-system.so' name='s'/>"
      "<plugin filename='gz-sim-wind-effects-system' name='w'/>",
      "1.9");
  ASSERT_EQ(w.plugins.size(), 1u);
  EXPECT_EQ(w.plugins[0].filename, "gz-sim-wind-effects-system");
}

TEST_F(GzSystems, ALidarPublishesOnItsTopic) {
  const std::string scan =
      "<update_rate>10</update_rate><topic>scan</topic><lidar><scan>"
      "<horizontal><samples>8</samples></horizontal>";
  const SensorDescription flat =
      sensor("<sensor name='s' type='gpu_lidar'>" + scan + "</scan></lidar></sensor>");
  EXPECT_EQ(flat.plugins.at(0).filename, "libgazebo_ros_gpu_laser.so");
  EXPECT_EQ(keys_of(flat.plugins[0]), (Keys{{"topicName", "scan"}, {"frameName", "base"}}));
  const SensorDescription deep =
      sensor("<sensor name='s' type='gpu_lidar'><gz_frame_id>f</gz_frame_id>" + scan +
             "<vertical><samples>16</samples></vertical></scan></lidar></sensor>");
  EXPECT_EQ(deep.plugins.at(0).filename, "libgazebo_ros_velodyne_gpu_laser.so");
  EXPECT_EQ(keys_of(deep.plugins[0]),
            (Keys{{"topicName", "scan/points"}, {"frameName", "f"}, {"organize_cloud", "true"}}));
  // Without a plugin, Gazebo Classic's sensors publish nothing on ROS.
  EXPECT_TRUE(sensor("<sensor name='s' type='ray'/>").plugins.empty());
  EXPECT_TRUE(sensor("<sensor name='s' type='ray'><topic>__default_topic__</topic></sensor>")
                  .plugins.empty());
  EXPECT_EQ(warnings_->size(), 2u);
  EXPECT_TRUE(warned("<sensor>: found no <plugin> in it, expected one; it publishes nothing"));
}

TEST_F(GzSystems, CamerasPublishBesideTheirTopic) {
  const SensorDescription color = sensor(
      "<sensor name='s' type='camera'><topic>front/image</topic><camera>"
      "<optical_frame_id>eye</optical_frame_id></camera></sensor>");
  EXPECT_EQ(keys_of(color.plugins.at(0)), (Keys{{"frameName", "eye"},
                                                {"imageTopicName", "front/image"},
                                                {"cameraInfoTopicName", "front/camera_info"}}));
  EXPECT_TRUE(color.element.child("camera")->children.empty());
  for (const std::string truth : {"1", "true", "0"}) {
    const SensorDescription waits =
        sensor("<sensor name='s' type='camera'><topic>image</topic><camera><triggered>" + truth +
               "</triggered></camera></sensor>");
    EXPECT_EQ(keys_of(waits.plugins.at(0)).at("triggered"), truth);
  }
  const Keys depth = keys_of(sensor("<sensor name='d' type='rgbd_camera'/>").plugins.at(0));
  EXPECT_EQ(depth.at("imageTopicName"), "d/image");
  EXPECT_EQ(depth.at("depthImageTopicName"), "d/depth_image");
  EXPECT_EQ(depth.at("pointCloudTopicName"), "d/points");
}

TEST_F(GzSystems, ReceiversAndMagnetometersArePluginsOfTheModel) {
  const auto m = model(
      "<link name='a'/><link name='mast'>"
      "<sensor name='gps' type='navsat'><update_rate>5</update_rate>"
      "<topic>fix</topic><navsat><position_sensing><horizontal><noise>"
      "<stddev>0.5</stddev></noise></horizontal></position_sensing></navsat></sensor>"
      "<sensor name='mag' type='magnetometer'><topic>field</topic></sensor></link>",
      "1.9");
  EXPECT_TRUE(m->links.at(1).sensors.empty());
  ASSERT_EQ(m->plugins.size(), 2u);
  const Keys gps = keys_of(m->plugins[0]);
  EXPECT_EQ(m->plugins[0].filename, "libhector_gazebo_ros_gps.so");
  EXPECT_EQ(gps.at("bodyName"), "mast");
  EXPECT_EQ(gps.at("topicName"), "fix");
  EXPECT_EQ(gps.at("updateRate"), "5");
  EXPECT_EQ(gps.at("gaussianNoise"), "0.5 0.5 0");
  EXPECT_EQ(keys_of(m->plugins[1]).at("topicName"), "field");
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(GzSystems, AUrdfsBlocksMayHoldThem) {
  const auto m = robot(
      "<link name='a'/><gazebo reference='a'><sensor name='imu' type='imu'><topic>imu</topic>"
      "</sensor><sensor name='c' type='contact'><contact><collision>c</collision><topic>touch"
      "</topic></contact></sensor><sensor name='h' type='altimeter'><topic>height</topic></sensor>"
      "</gazebo>");
  const auto& sensors = m->links.at(0).sensors;
  EXPECT_EQ(keys_of(sensors.at(0).plugins.at(0)).at("topicName"), "imu");
  EXPECT_EQ(keys_of(sensors.at(1).plugins.at(0)).at("bumperTopicName"), "touch");
  EXPECT_TRUE(warned("found sensor type 'altimeter', which publishes nothing here"));
}

}  // namespace
}  // namespace ardee
