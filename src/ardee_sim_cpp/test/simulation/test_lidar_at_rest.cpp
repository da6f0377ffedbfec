// SPDX-License-Identifier: MIT
// Tests of the beams of a robot at rest, which is turned by angles of some 1e-19.
#include <gtest/gtest.h>

#include <cmath>

#include "fixture.h"

namespace ardee {
using namespace devices;
namespace {

constexpr double kTurn_rad = 2.0 * M_PI;

struct Device {
  std::string name;
  std::string type;
  std::string plugin;
  int samples;
  double span_rad;
};

/// Returns a box that carries the device 5 cm above itself.
std::string carrier(const Device& device, bool is_static) {
  const std::string half = std::to_string(0.5 * device.span_rad);
  return "<sdf version='1.6'><model name='carrier'><static>" +
         std::string(is_static ? "true" : "false") +
         "</static><link name='base'><inertial><mass>1</mass><inertia><ixx>0.008</ixx>"
         "<iyy>0.014</iyy><izz>0.02</izz></inertia></inertial>"
         "<collision name='c'><geometry><box><size>0.4 0.3 0.1</size></box></geometry></collision>"
         "<sensor name='lidar' type='" +
         device.type + "'><pose>0.1 0 0.1 0 0 0</pose><update_rate>10</update_rate><ray><scan>" +
         "<horizontal><samples>" + std::to_string(device.samples) + "</samples><min_angle>-" +
         half + "</min_angle><max_angle>" + half +
         "</max_angle></horizontal></scan><range><min>0.06</min><max>30</max></range></ray>"
         "<plugin name='lidar' filename='" +
         device.plugin + "'><topicName>scan</topicName></plugin></sensor></link></model></sdf>";
}

/// Returns a wall ahead of a robot at the origin, its near face at 2.9 m, and other bodies about
/// it.
std::string wall_ahead(double yaw_rad) {
  const std::string pose = std::to_string(3.0 * std::cos(yaw_rad)) + " " +
                           std::to_string(3.0 * std::sin(yaw_rad)) + " 1 0 0 " +
                           std::to_string(yaw_rad);
  return static_box("wall", pose, "0.2 4 2") + static_box("far", "-40 -40 1 0 0 0", "1 1 1") +
         static_box("farther", "40 50 1 0 0 0", "1 1 1");
}

/// Returns how often a beam has a hit and its neighbour none, or the reverse; the last and the
/// first beam are neighbours.
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

/// Expects that a level scan hits one wall in one run of beams, 2.8 m ahead.
void expect_wall(const Recorder& recorder, TimeNs from_ns) {
  int scans = 0;
  for (const LidarReading& scan : recorder.on<LidarReading>("/scan")) {
    if (scan.header.stamp_ns < from_ns) continue;
    ++scans;
    ASSERT_EQ(borders(scan.ranges_m), 2);
    ASSERT_NEAR(scan.ranges_m[scan.ranges_m.size() / 2], 2.8f, 0.02f);
  }
  EXPECT_GT(scans, 0);
}

TEST_P(AtRest, LosesNoBeamOfAWallAfterSettling) {
  for (const double roll_rad : {0.0, 0.02, -0.05}) {
    for (const double yaw_rad : {0.0, 1.571, 3.142, -1.571, 0.3, 0.7854}) {
      SCOPED_TRACE("roll " + std::to_string(roll_rad) + ", yaw " + std::to_string(yaw_rad));
      TestWorld world(ground_plane() + wall_ahead(yaw_rad));
      world.spawn(carrier(GetParam(), false), "carrier",
                  Pose::from_xyz_rpy({0, 0, 0.1}, {roll_rad, 0, yaw_rad}));
      world.run(2.0);
      expect_wall(world.recorder(), nanoseconds(1.5));
    }
  }
}

TEST_P(AtRest, LosesNoBeamOfAWallWhateverItsTinyTurns) {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  for (const double yaw_rad : {0.0, M_PI / 2, M_PI, 0.3}) {
    for (const double roll_rad : {-1e-7, 0.0, 1e-7}) {
      for (const double pitch_rad : {-1e-19, -1e-25, 0.0, 1e-25, 1e-19, 1e-18}) {
        SCOPED_TRACE(testing::Message() << yaw_rad << ", " << roll_rad << ", " << pitch_rad);
        TestWorld world(wall_ahead(yaw_rad));
        const Eigen::Quaterniond tiny(1.0, 0.5 * roll_rad, 0.5 * pitch_rad, 0.0);
        const Eigen::Quaterniond yaw(Eigen::AngleAxisd(yaw_rad, z));
        world.spawn(carrier(GetParam(), true), "carrier", {{0, 0, 0.1}, yaw * tiny});
        world.run(0.1);
        expect_wall(world.recorder(), 0);
      }
    }
  }
}

}  // namespace
}  // namespace ardee
