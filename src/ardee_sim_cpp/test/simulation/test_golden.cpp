// SPDX-License-Identifier: MIT
// Five runs and the hashes of their results: they show every change of behaviour, and other tests
// tell whether it is right. The C library's sines differ in the last bit between processors with
// and without FMA instructions; the hashes are those of one with them.
#include <gtest/gtest.h>

#include "../test_data.h"
#include "all_devices.h"
#include "ardee_sim/core/rng.h"
#include "fixture.h"
#include "reading_bytes.h"

namespace ardee {
namespace {

/// Returns a hash of all readings in `duration_s`, and of the final poses of all links of models.
std::uint64_t hash_of(TestWorld& world, double duration_s) {
  BytesByTopic sink;
  world->set_sink(&sink);
  world.run(duration_s);
  std::string all;
  for (const auto& [topic, bytes] : sink.take()) all += topic + bytes;
  for (const auto& entity : world->entities()) {
    if (entity->is_static()) continue;
    for (const Link& link : entity->instance.model->links) {
      const Pose X_WL = world->state(entity->name() + "::" + link.name, "").pose;
      for (const double value :
           {X_WL.p.x(), X_WL.p.y(), X_WL.p.z(), X_WL.q.x(), X_WL.q.y(), X_WL.q.z(), X_WL.q.w()}) {
        all.append(reinterpret_cast<const char*>(&value), sizeof value);
      }
    }
  }
  return stream_key(0, all);
}

std::string boards() {
  std::string models;
  for (int k = 0; k < 12; ++k) {
    models += static_box("board" + std::to_string(k),
                         std::to_string(0.5 * k - 1.0) + (k % 2 != 0 ? " 0.6" : " -0.6") +
                             " 0.2 0.1 0.2 " + std::to_string(0.4 * k),
                         "0.3 0.02 0.4");
  }
  return models;
}

const Pose kOnWheels = Pose::from_xyz_rpy({0, 0, 0.151}, {0, 0, 0});

std::uint64_t drive_with(const std::vector<std::string>& devices) {
  TestWorld world(ground_plane() + boards(), 0.005);
  Entity& robot = world.spawn(rover_with(devices), "rover", kOnWheels);
  command_all(robot);
  return hash_of(world, 2.0);
}

TEST(Golden, DrivesAndControllers) { EXPECT_EQ(drive_with(drive_devices()), 0x883ecae8bef4a944u); }

TEST(Golden, MotionAndForceSensors) {
  std::vector<std::string> devices = motion_devices();
  for (const std::string& device : force_devices()) devices.push_back(device);
  devices.push_back(drive_devices()[1]);
  EXPECT_EQ(drive_with(devices), 0x09c58bc629a6631fu);
}

TEST(Golden, RaySensors) { EXPECT_EQ(drive_with(ray_devices()), 0xe2b2b754fa1e7e11u); }

TEST(Golden, Cameras) { EXPECT_EQ(drive_with(camera_devices()), 0xbcaba0c59f7b864bu); }

TEST(Golden, AHeapThatFallsOnHeights) {
  const std::string heights = "<heightmap><uri>file://" + test_data() +
                              "/images/grey8.png</uri><size>8 8 0.5</size></heightmap>";
  std::string models =
      "<model name='ground'><static>true</static><link name='link'><collision "
      "name='c'><geometry>" +
      heights + "</geometry></collision></link></model>";
  const std::vector<std::string> shapes = {
      "<box><size>0.2 0.3 0.1</size></box>", "<sphere><radius>0.15</radius></sphere>",
      "<cylinder><radius>0.1</radius><length>0.3</length></cylinder>"};
  for (int k = 0; k < 12; ++k) {
    const std::string at = std::to_string(0.05 * k) + " 0 " + std::to_string(0.8 + 0.3 * k) +
                           " 0.3 " + std::to_string(0.2 * k) + " 0.1";
    models += "<model name='m" + std::to_string(k) + "'><pose>" + at +
              "</pose><link name='link'><inertial><mass>1</mass><inertia><ixx>0.01</ixx>"
              "<iyy>0.01</iyy><izz>0.01</izz></inertia></inertial><collision "
              "name='c'><geometry>" +
              shapes[static_cast<std::size_t>(k) % 3] + "</geometry></collision></link></model>";
  }
  TestWorld world(models, 0.002);
  EXPECT_EQ(hash_of(world, 2.0), 0x08f785d0a952f8e3u);
}

}  // namespace
}  // namespace ardee
