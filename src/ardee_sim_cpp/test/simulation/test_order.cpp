// SPDX-License-Identifier: MIT
// Tests that a run depends neither on the order of plugins and models in the file nor on the order
// in which models are spawned.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "all_devices.h"
#include "reading_bytes.h"

namespace ardee {
using namespace devices;
namespace {

using Bytes = std::map<std::string, std::string>;

const Pose kOnWheels = Pose::from_xyz_rpy({0, 0, 0.151}, {0, 0, 0});

template <typename Run>
void expect_same_in_any_order(std::vector<std::string> parts, const Run& run) {
  const Bytes reference = run(parts);
  EXPECT_FALSE(reference.empty());
  std::reverse(parts.begin(), parts.end());
  std::mt19937 random(7);
  for (int trial = 0; trial < 4; ++trial) {
    for (const std::string& topic : differing(reference, run(parts))) {
      ADD_FAILURE() << "trial " << trial << ": other bytes on " << topic;
    }
    std::shuffle(parts.begin(), parts.end(), random);
  }
}

Bytes bytes_of(TestWorld& world, double duration_s) {
  BytesByTopic bytes;
  world->set_sink(&bytes);
  world.run(duration_s);
  return bytes.take();
}

TEST(Order, OfPluginsDoesNotMatter) {
  const std::string scene = ground_plane() + static_box("wall", "3 0 1 0 0 0", "0.2 4 2");
  expect_same_in_any_order(all_devices(), [&scene](const std::vector<std::string>& devices) {
    TestWorld world(scene, 0.005);
    command_all(world.spawn(rover_with(devices), "rover", kOnWheels));
    return bytes_of(world, 0.6);
  });
}

TEST(Order, OfPluginsOfOneNameDoesNotMatter) {
  std::vector<std::string> devices;
  for (const char* topic : {"a", "b", "c"}) {
    const std::string keys = "<bodyName>mast</bodyName><gaussianNoise>0.1</gaussianNoise>";
    devices.push_back("<gazebo><plugin name='same' filename='libgazebo_ros_imu.so'>" + keys +
                      "<topicName>" + topic + "</topicName></plugin></gazebo>");
  }
  expect_same_in_any_order(devices, [](const std::vector<std::string>& written) {
    TestWorld world(free_space(0.0), 0.005);
    world.spawn(rover_with(written), "rover");
    const Bytes bytes = bytes_of(world, 0.1);
    EXPECT_NE(bytes.at("/a"), bytes.at("/b")) << "each has noise of its own";
    return bytes;
  });
}

TEST(Order, AnImuFeelsWhatADriveDoesWhicheverIsFirst) {
  const std::string move = plugin("gazebo_ros_planar_move", "", "move");
  for (const char* name : {"imu before", "z imu after"}) {
    TestWorld world(free_space(0.0), 0.001);
    Entity& robot = world.spawn(ball(plugin("hector_gazebo_ros_imu", "", name) + move), "ball");
    world.command(robot, 1.0, 1.0);
    world.run(1.0);
    // The robot drives a circle: v w = 1 m/s^2 to the left.
    const ImuReading last = world.recorder().on<ImuReading>("/imu").back();
    expect_near(last.linear_acceleration, {0, 1, 0}, 1e-3);
  }
}

/// Returns a box of 0.3 m on the ground that publishes its pose and its view of a wall.
std::string crate(const std::string& name, const std::string& pose, const std::string& more = "") {
  const std::string geometry = "<geometry><box><size>0.3 0.3 0.3</size></box></geometry>";
  return "<model name='" + name + "'><pose>" + pose +
         "</pose><link name='link'><inertial><mass>5</mass><inertia><ixx>0.075</ixx><iyy>0.075"
         "</iyy><izz>0.075</izz></inertia></inertial><collision name='c'>" +
         geometry + "</collision><visual name='v'>" + geometry +
         "</visual><sensor name='lidar' type='ray'><pose>0 0 0.2 0 0 0</pose><update_rate>40"
         "</update_rate>" +
         noisy_rays() +
         "<plugin name='lidar' filename='libgazebo_ros_gpu_laser.so'><robotNamespace>" + name +
         "</robotNamespace><topicName>scan</topicName></plugin></sensor></link>" +
         plugin("gazebo_ros_p3d",
                "<robotNamespace>" + name +
                    "</robotNamespace><bodyName>link</bodyName><topicName>truth</topicName>") +
         more + "</model>";
}

/// Returns a robot that drives into any body on +x.
std::string pusher(const std::string& name, const std::string& pose) {
  return crate(
      name, pose,
      plugin("gazebo_ros_planar_move", "<robotNamespace>" + name + "</robotNamespace>", "move"));
}

/// Runs models, in their order in the text, in a world of one file.
Bytes run_world(const std::vector<std::string>& models, double duration_s) {
  std::string text;
  for (const std::string& model : models) text += model;
  TestWorld world(text, 0.002);
  for (const auto& entity : world->entities()) world.command(*entity, 0.5, 0.1);
  return bytes_of(world, duration_s);
}

/// Does the same with all models spawned at once, one after the other.
Bytes run_spawned(const std::vector<std::string>& models, double duration_s) {
  TestWorld world("", 0.002);
  for (const std::string& model : models) {
    const std::size_t start = model.find('\'') + 1;
    const std::string name = model.substr(start, model.find('\'', start) - start);
    world.command(world.spawn("<sdf version='1.6'>" + model + "</sdf>", name), 0.5, 0.1);
  }
  return bytes_of(world, duration_s);
}

TEST(Order, OfModelsDoesNotDecideWhichOfTwoSurfacesInOnePlaneIsMet) {
  const auto wall = [](const std::string& name, double y_m, const std::string& color, int retro) {
    const std::string geometry = "<geometry><box><size>1 2 2</size></box></geometry>";
    return "<model name='" + name + "'><static>1</static><pose>3 " + std::to_string(y_m) +
           " 1 0 0 0</pose><link name='l'><visual name='v'>" + geometry + "<material><diffuse>" +
           color + "</diffuse></material><laser_retro>" + std::to_string(retro) +
           "</laser_retro></visual></link></model>";
  };
  const std::string eye =
      "<sensor name='eye' type='camera'><update_rate>10</update_rate>" + noisy_eye() +
      plugin("gazebo_ros_camera", "<segmentation>true</segmentation>") +
      "</sensor><sensor name='lidar' type='gpu_ray'><update_rate>10</update_rate>" + noisy_rays() +
      plugin("gazebo_ros_gpu_laser", "<topicName>scan</topicName>") + "</sensor>";
  const std::string post =
      "<model name='post'><static>1</static><pose>0 0 1 0 0 0</pose>"
      "<link name='l'>" +
      eye + "</link></model>";
  expect_same_in_any_order({wall("red", 0.2, "1 0 0 1", 10), wall("white", -0.3, "1 1 1 1", 20),
                            wall("dark", 0.0, "0 0 0 1", 30), post},
                           [](const auto& models) { return run_world(models, 0.1); });
}

using RunModels = Bytes (*)(const std::vector<std::string>&, double);
class OrderOfModels : public testing::TestWithParam<RunModels> {};

TEST_P(OrderOfModels, DoesNotMatterApart) {
  expect_same_in_any_order(
      {ground_plane(), static_box("wall", "3 0 1 0 0 0", "0.2 6 2"), pusher("a", "0 0 0.15 0 0 0"),
       pusher("b", "0 2 0.15 0 0 0.5"), crate("c", "0 -2 1 0.3 0.2 0.1")},
      [](const auto& models) { return GetParam()(models, 1.0); });
}

TEST_P(OrderOfModels, DoesNotMatterWhereTheyTouch) {
  // Two rows are pushed along a wall, in contact with it, the ground and one another.
  expect_same_in_any_order({ground_plane(), static_box("wall", "2 0.65 1 0 0 0", "6 1 2"),
                            pusher("d", "0 0 0.15 0 0 0.1"), crate("a", "0.31 0.01 0.15 0 0 0"),
                            crate("c", "0.62 -0.02 0.15 0 0 0.05"), pusher("b", "0 -2 0.15 0 0 0"),
                            crate("e", "0.305 -2.05 0.15 0 0 0")},
                           [](const auto& models) { return GetParam()(models, 1.0); });
}

TEST_P(OrderOfModels, DoesNotMatterWhereTheSolverIterates) {
  // Two towers, each with more constraint rows than the direct solver takes.
  std::vector<std::string> models{ground_plane()};
  for (int i = 0; i < 9; ++i) {
    const std::string z = std::to_string(0.15 + 0.3 * i);
    models.push_back(crate("x" + std::to_string((i * 4) % 9), "0 0 " + z + " 0 0 0.2"));
    models.push_back(crate("y" + std::to_string((i * 5) % 9), "0.02 3 " + z + " 0 0 0"));
  }
  expect_same_in_any_order(models, [](const auto& them) { return GetParam()(them, 0.1); });
}

INSTANTIATE_TEST_SUITE_P(Ways, OrderOfModels, testing::Values(&run_world, &run_spawned),
                         [](const auto& way) { return way.index == 0 ? "Written" : "Spawned"; });

}  // namespace
}  // namespace ardee
