// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "fixture.h"

namespace ardee {
using namespace devices;
namespace {

std::string receiver(const std::string& file, const std::string& keys) {
  return "<robot name='r'><link name='l'><inertial><mass value='1'/><inertia ixx='1' ixy='0' "
         "ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link><gazebo><plugin name='p' filename='" +
         file + "'>" + keys + "</plugin></gazebo></robot>";
}

const std::string kGravityFree = "<gravity>0 0 0</gravity>";

TEST(PluginAliases, OfTheThesisReceiverIsHectors) {
  // The plugins are those of listings A.1 and A.2.
  TestWorld world(kGravityFree);
  world.spawn(receiver("libgazebo_ros_gps.so",
                       "<bodyName>l</bodyName><topicName>gps</topicName>"
                       "<velocityTopicName>gps/fix_velocity</velocityTopicName><updateRate>5"
                       "</updateRate><referenceLatitude>40.1105875</referenceLatitude>"
                       "<referenceLongitude>-88.2072697</referenceLongitude>"),
              "r");
  world.run(1.0);
  const auto fixes = world.recorder().on<FixReading>("/gps");
  ASSERT_EQ(fixes.size(), 5u);
  EXPECT_NEAR(fixes[0].latitude_deg, 40.1105875, 1e-9);
  EXPECT_TRUE(world.messages().empty());
}

std::string shipped(const std::string& plugin, const std::string& keys) {
  return "<gazebo><plugin name='" + plugin + "' filename='" + plugin + "'><robotNamespace>" +
         plugin + "</robotNamespace>" + keys + "</plugin></gazebo>";
}

TEST(PluginAliases, OfTheLibraryPublishWhatTheirPluginsDo) {
  // Each row of the file publishes on this topic, below a namespace of its own.
  const std::map<std::string, std::pair<std::string, std::string>> topics{
      {"libgazebo_ros_gps.so", {"fix", ""}},
      {"libhector_gazebo_ros_gps_with_dropout.so", {"fix", ""}},
      {"libgazebo_ros_imu_mod.so", {"imu", ""}},
      {"libhector_gazebo_ros_imu_mod.so", {"imu", ""}},
      {"libgazebo_ros_encoder.so", {"encoder", "<jointName>j</jointName>"}},
      {"libgazebo_ros_encoders.so", {"encoder", "<jointName>j</jointName>"}},
      {"libgazebo_ros_battery_simple.so", {"ardee/battery", ""}},
      {"libbattery_simple.so", {"ardee/battery", ""}}};
  const std::string inertial =
      "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"
      "</inertial>";
  std::string robot = "<robot name='r'><link name='l'>" + inertial + "</link><link name='w'>" +
                      inertial +
                      "</link><joint name='j' type='continuous'><parent link='l'/><child link='w'/>"
                      "<axis xyz='0 1 0'/></joint>";
  ASSERT_EQ(builtin_aliases().size(), topics.size());
  for (const PluginAlias& alias : builtin_aliases()) {
    robot += shipped(alias.filename, topics.at(alias.filename).second);
  }
  TestWorld world(kGravityFree);
  world.spawn(robot + "</robot>", "r");
  world.run(0.5);
  for (const auto& [plugin, topic] : topics) {
    EXPECT_GT(world.recorder().count("/" + plugin + "/" + topic.first), 0u) << plugin;
  }
  EXPECT_TRUE(world.messages().empty());
}

TEST(PluginAliases, OfTheUsersRenameTheirKeys) {
  SimulationOptions options;
  options.plugin_aliases = {{"liblab_receiver.so",
                             "libhector_gazebo_ros_gps.so",
                             {{"lat0", "referenceLatitude"}, {"out", "topicName"}}}};
  TestWorld world(kGravityFree, 0.001, options);
  world.spawn(receiver("/opt/lab/liblab_receiver.so", "<lat0>12.5</lat0><out>where</out>"), "r");
  world.run(0.5);
  const auto fixes = world.recorder().on<FixReading>("/where");
  ASSERT_FALSE(fixes.empty());
  EXPECT_NEAR(fixes[0].latitude_deg, 12.5, 1e-9);
}

std::string refusal(const PluginAlias& alias) {
  Registry registry = builtin_registry();
  try {
    registry.add_alias(alias);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(PluginAliases, AreRefusedWithoutAPluginOrAName) {
  EXPECT_NE(
      refusal({"liba.so", "libhector_gazebo_ros_gsp.so", {}})
          .find("plugin alias 'liba.so': found plugin 'libhector_gazebo_ros_gsp.so', expected "
                "one in docs/support.md; nearest: libhector_gazebo_ros_gps.so, "),
      std::string::npos);
  EXPECT_NE(refusal({"libgazebo_ros_camera.so", "libgazebo_ros_imu.so", {}}).find("not taken"),
            std::string::npos);
  EXPECT_NE(refusal({"libgazebo_ros_gps.so", "libgazebo_ros_imu.so", {}}).find("not taken"),
            std::string::npos);
  EXPECT_EQ(refusal({"liba.so", "gazebo_ros_imu", {}}), "");
}

}  // namespace
}  // namespace ardee
