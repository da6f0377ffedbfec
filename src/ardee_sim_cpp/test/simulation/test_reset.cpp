// SPDX-License-Identifier: MIT
// Tests that a reset restores the state after construction.
#include <gtest/gtest.h>

#include <cstring>

#include "all_devices.h"
#include "ardee_sim/simulation/plugins.h"
#include "reading_bytes.h"

namespace ardee {
using namespace devices;
namespace {

const Pose kOnWheels = Pose::from_xyz_rpy({0, 0, 0.151}, {0, 0, 0});
const std::string kScene = ground_plane() + static_box("wall", "3 0 1 0 0 0", "0.2 4 2");

/// Changes every property that a running robot has.
void tune_all(Entity& robot) {
  for (const auto& device : robot.devices) {
    for (const ParameterGroup& tuning : device->ports().all<ParameterGroup>()) {
      for (const TunableParameter& each : tuning.parameters) {
        each.set(each.get() == each.high ? each.low : each.high);
      }
    }
    for (const Service& service : device->ports().all<Service>()) {
      if (const auto* act = std::get_if<0>(&service.act)) (*act)();
      if (const auto* act = std::get_if<1>(&service.act)) (*act)({1, 2, 3});
      if (const auto* act = std::get_if<2>(&service.act)) {
        (*act)({12.0, 34.0, 56.0, quaternion_from_rpy({0, 0, 0.7})});
      }
    }
  }
  command_all(robot);
}

TEST(Reset, OfTheSimulationRepeatsTheBytesOfEachDeviceWhateverWasTuned) {
  TestWorld world(kScene, 0.005);
  Entity& robot = world.spawn(rover_with(all_devices()), "rover", kOnWheels);
  BytesByTopic bytes;
  world->set_sink(&bytes);
  const auto run = [&] {
    world.run(0.2);
    command_all(robot);
    world.run(0.6);
    return bytes.take();
  };
  const auto first = run();
  tune_all(robot);
  const auto tuned = run();
  for (const char* topic : {"/gps/fix", "/hector/fix", "/imu", "/sonar", "/magnetic"}) {
    EXPECT_NE(tuned.at(topic), first.at(topic)) << topic << " is not tuned";
  }
  world->reset_simulation();
  for (const std::string& topic : differing(first, run())) {
    ADD_FAILURE() << "other bytes on " << topic;
  }
}

TEST(Reset, TestsEachPluginThatThereIs) {
  const std::string robot = rover_with(all_devices());
  const Registry registry = known_plugins();
  for (const auto& files : {registry.model_plugin_files(), registry.sensor_plugin_files()}) {
    EXPECT_GT(files.size(), 10u);
    for (const std::string& file : files) {
      EXPECT_NE(robot.find("'" + file + "'"), std::string::npos) << file;
    }
  }
}

/// Returns the noise in the readings of a robot at rest.
std::map<std::string, std::string> noise_of(const std::string& more) {
  TestWorld world(free_space(0.0), 0.01);
  world.spawn(ball(plugin("gazebo_ros_imu",
                          "<bodyName>body</bodyName><topicName>imu</topicName>"
                          "<gaussianNoise>0.1</gaussianNoise>" +
                              more) +
                   plugin("gazebo_ros_p3d",
                          "<bodyName>body</bodyName><topicName>truth</topicName>"
                          "<gaussianNoise>0.1</gaussianNoise>" +
                              more,
                          "p3d")),
              "ball");
  std::map<std::string, std::string> noise;
  const auto record = [&](const std::string& name) {
    world.recorder().clear();
    world.run(0.05);
    const auto keep = [&](const std::string& topic, const Eigen::Vector3d& value) {
      noise[topic + name].append(reinterpret_cast<const char*>(value.data()), sizeof(value));
    };
    for (const auto& each : world.recorder().on<ImuReading>("/imu")) {
      keep("imu ", each.linear_acceleration);
    }
    for (const auto& each : world.recorder().on<OdometryReading>("/truth")) {
      keep("p3d ", each.twist.linear);
    }
  };
  record("first");
  world->reset_world();
  record("second");
  world->reset_world();
  record("third");
  world->reset_simulation();
  record("again");
  return noise;
}

TEST(Reset, OfTheWorldLetsNoiseGoOnAtAnyRate) {
  for (const char* rate : {"", "<updateRate>100</updateRate>"}) {
    auto noise = noise_of(rate);
    for (const std::string topic : {"imu ", "p3d "}) {
      ASSERT_FALSE(noise[topic + "first"].empty());
      EXPECT_NE(noise[topic + "second"], noise[topic + "first"]) << topic << rate;
      EXPECT_NE(noise[topic + "third"], noise[topic + "first"]) << topic << rate;
      EXPECT_NE(noise[topic + "third"], noise[topic + "second"]) << topic << rate;
      EXPECT_EQ(noise[topic + "again"], noise[topic + "first"]) << topic << rate;
    }
  }
}

TEST(Reset, OfTheWorldGivesTheNumbersOfTheDescriptionToo) {
  TestWorld world(free_space(0.0), 0.01);
  Entity& robot = world.spawn(
      ball(plugin("hector_gazebo_ros_gps", "<topicName>fix</topicName><offset>1 2 3</offset>")),
      "ball");
  set(tuning(robot, "/fix/position"), "offset", 9.0);
  std::get<2>(service(robot, "/fix/set_reference_geopose").act)({10.0, 20.0, 30.0, {}});
  world->reset_world();
  world.run(0.5);
  const FixReading fix = world.recorder().on<FixReading>("/fix").back();
  EXPECT_NEAR(fix.altitude_m, 3.0, 1e-9);
  EXPECT_NEAR(fix.latitude_deg, 49.9, 1e-4);
}

}  // namespace
}  // namespace ardee
