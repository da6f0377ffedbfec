// SPDX-License-Identifier: MIT
// A robot that has come to rest is turned by 1e-19 and the like, and its beams with it.
#include <gtest/gtest.h>

#include <cmath>

#include "fixture.h"

namespace ardee {
namespace {

constexpr double kTurn_rad = 2.0 * M_PI;

struct Device {
  std::string name;
  std::string type;
  std::string plugin;
  int samples;
  double span_rad;
};

/// A box on the ground that carries the device 5 cm above itself.
std::string carrier(const Device& device) {
  const std::string half = std::to_string(0.5 * device.span_rad);
  return "<sdf version='1.6'><model name='carrier'><link name='base'><collision name='c'><geometry>"
         "<box><size>0.4 0.3 0.1</size></box></geometry></collision>"
         "<sensor name='lidar' type='" +
         device.type + "'><pose>0.1 0 0.1 0 0 0</pose><update_rate>10</update_rate><ray><scan>" +
         "<horizontal><samples>" + std::to_string(device.samples) + "</samples><min_angle>-" +
         half + "</min_angle><max_angle>" + half +
         "</max_angle></horizontal></scan><range><min>0.06</min><max>30</max></range></ray>"
         "<plugin name='lidar' filename='" +
         device.plugin + "'><topicName>scan</topicName></plugin></sensor></link></model></sdf>";
}

/// How often neighbours differ in whether they meet anything, the last and the first beam being
/// neighbours.
int borders(const std::vector<float>& ranges_m) {
  int count = 0;
  for (std::size_t beam = 0; beam < ranges_m.size(); ++beam) {
    const float next_m = ranges_m[(beam + 1) % ranges_m.size()];
    count += std::isfinite(ranges_m[beam]) != std::isfinite(next_m) ? 1 : 0;
  }
  return count;
}

class AtRest : public testing::TestWithParam<Device> {};
INSTANTIATE_TEST_SUITE_P(
    Lidar, AtRest,
    testing::Values(Device{"ust10lx", "gpu_ray", "libgazebo_ros_gpu_laser.so", 1081, 4.71238898},
                    Device{"ust10lx_ray", "ray", "libgazebo_ros_laser.so", 1081, 4.71238898},
                    Device{"rplidar", "ray", "libgazebo_ros_laser.so", 360, kTurn_rad},
                    Device{"whole_turn", "gpu_ray", "libgazebo_ros_gpu_laser.so", 721, kTurn_rad},
                    Device{"tim571", "ray", "libgazebo_ros_laser.so", 811, 4.71238898}),
    [](const auto& device) { return device.param.name; });

/// A level scan meets one wall in one run of beams, also where it meets the things beside it.
TEST_P(AtRest, LosesNoBeamOfAWall) {
  const std::string ground =
      "<model name='ground'><static>true</static><link name='l'><collision name='c'><geometry>"
      "<plane><normal>0 0 1</normal></plane></geometry></collision></link></model>";
  for (const double roll_rad : {0.0, 0.02}) {
    for (const double yaw_rad : {0.0, 1.571, 3.142, -1.571, 0.3, 0.7854}) {
      // The wall stands ahead of the robot, whichever way that is.
      const double turn_rad = yaw_rad;
      const std::string wall = static_box("wall",
                                          std::to_string(3.0 * std::cos(turn_rad)) + " " +
                                              std::to_string(3.0 * std::sin(turn_rad)) + " 1 0 0 " +
                                              std::to_string(turn_rad),
                                          "0.2 4 2");
      TestWorld world(ground + wall + static_box("far", "-40 -40 1 0 0 0", "1 1 1"));
      world.spawn(carrier(GetParam()), "carrier",
                  Pose::from_xyz_rpy({0, 0, 0.1}, {roll_rad, 0, yaw_rad}));
      world.run(1.0);
      for (const LidarReading& scan : world.recorder().on<LidarReading>("/scan")) {
        if (scan.header.stamp_ns < nanoseconds(0.5)) continue;
        ASSERT_EQ(borders(scan.ranges_m), 2) << "roll " << roll_rad << ", yaw " << yaw_rad;
        const float ahead_m = scan.ranges_m[scan.ranges_m.size() / 2];
        ASSERT_NEAR(ahead_m, 2.8f, 0.02f) << "roll " << roll_rad << ", yaw " << yaw_rad;
      }
    }
  }
}

}  // namespace
}  // namespace ardee
