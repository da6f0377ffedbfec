// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fixture.h"
#include "rover.h"

namespace ardee {
using namespace devices;
namespace {

constexpr double kTurn_rad = 2.0 * M_PI;

/// Returns a wheel of 0.2 m diameter on a bracket that is fixed to the world, with an encoder of
/// 150 pulses a turn.
std::string test_bench(const std::string& keys, const std::string& joint = "axle") {
  return "<sdf version='1.6'><model name='bench'><link name='bracket'/><link name='wheel'>"
         "<inertial><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia>"
         "</inertial></link>"
         "<joint name='mount' type='fixed'><parent>world</parent><child>bracket</child></joint>"
         "<joint name='axle' type='revolute'><parent>bracket</parent><child>wheel</child>"
         "<axis><xyz>0 1 0</xyz></axis></joint>"
         "<plugin name='encoder' filename='libardee_ros_encoder.so'><joint>" +
         joint + "</joint><wheelDiameter>0.2</wheelDiameter><pulsesPR>150</pulsesPR>" + keys +
         "</plugin></model></sdf>";
}

EncoderReading last_reading(TestWorld& world) {
  return world.recorder().on<EncoderReading>("/encoder").back();
}

TEST(Encoder, CountsWholePulsesOverExactTurns) {
  TestWorld world("");
  Entity& bench = world.spawn(test_bench(""), "bench");
  const std::size_t axle = bench.robot->joint_index("axle", {});
  for (const double turns : {1.0, 3.0, 3.5, 100.0, -2.0, 1000.25}) {
    bench.robot->dynamics().set_joint_position(axle, turns * kTurn_rad);
    world.run(0.01);
    const double pulses = std::floor(turns * 150.0);
    EXPECT_NEAR(last_reading(world).position_rad, pulses * kTurn_rad / 150.0, 1e-9) << turns;
  }
}

TEST(Encoder, LiesLessThanAPulseBelowTheAngle) {
  TestWorld world("");
  Entity& bench = world.spawn(test_bench(""), "bench");
  const std::size_t axle = bench.robot->joint_index("axle", {});
  bench.robot->dynamics().set_joint_motor(axle, 1.234, 10.0);
  for (int i = 0; i < 200; ++i) {
    world.run(0.01);
    const double angle_rad = bench.robot->dynamics().joint_position(axle);
    const double behind_rad = angle_rad - last_reading(world).position_rad;
    EXPECT_GE(behind_rad, -1e-6);
    EXPECT_LT(behind_rad, kTurn_rad / 150.0 + 1e-6);
  }
}

TEST(Encoder, SpeedIsThePulsesOfTheLastTenthOfASecond) {
  TestWorld world("");
  Entity& bench = world.spawn(test_bench(""), "bench");
  const double rate_rad_per_s = 5.0;
  bench.robot->dynamics().set_joint_motor(bench.robot->joint_index("axle", {}), rate_rad_per_s,
                                          10.0);
  world.run(2.0);
  const EncoderReading reading = last_reading(world);
  const double one_pulse_per_s = 1.0 / 0.1;
  EXPECT_NEAR(reading.pulses_per_s, rate_rad_per_s * 150.0 / kTurn_rad, one_pulse_per_s);
  EXPECT_NEAR(std::remainder(reading.pulses_per_s, one_pulse_per_s), 0.0, 1e-6);  // whole pulses
  EXPECT_NEAR(reading.speed_m_per_s, reading.pulses_per_s * kTurn_rad / 150.0 * 0.1, 1e-12);
}

TEST(Encoder, IdealGivesTheJointItself) {
  TestWorld world("");
  Entity& bench = world.spawn(test_bench("<ideal>true</ideal><id>3</id>"), "bench");
  const std::size_t axle = bench.robot->joint_index("axle", {});
  bench.robot->dynamics().set_joint_motor(axle, 5.0, 10.0);
  world.run(1.0);
  const EncoderReading reading = last_reading(world);
  EXPECT_EQ(reading.id, 3);
  EXPECT_EQ(reading.header.frame_id, "wheel");
  EXPECT_DOUBLE_EQ(reading.position_rad, bench.robot->dynamics().joint_position(axle));
  EXPECT_NEAR(reading.speed_m_per_s, 5.0 * 0.1, 1e-3);
  EXPECT_NEAR(reading.pulses_per_s, 5.0 * 150.0 / kTurn_rad, 0.2);
}

TEST(Encoder, ComesAtItsRate) {
  TestWorld world("");
  world.spawn(test_bench("<updateRate>40</updateRate>"), "bench");
  world.run(2.0);
  EXPECT_EQ(world.recorder().on<EncoderReading>("/encoder").size(), 80u);
}

class BadEncoder : public testing::TestWithParam<std::string> {};

TEST_P(BadEncoder, IsLeftOutWithOneMessageAndTheModelIsThere) {
  TestWorld world("");
  const bool unknown = GetParam().empty();
  const Entity& bench =
      world.spawn(test_bench(GetParam(), unknown ? "no_such_joint" : "axle"), "bench");
  EXPECT_TRUE(bench.devices.empty());
  const auto is_about_it = [](const std::string& text) {
    return text.find("plugin 'encoder' (libardee_ros_encoder.so) is left out") != std::string::npos;
  };
  EXPECT_EQ(std::count_if(world.messages().begin(), world.messages().end(), is_about_it), 1);
  world.run(0.01);
}

INSTANTIATE_TEST_SUITE_P(Values, BadEncoder,
                         testing::Values("", "<updateRate>0</updateRate>",
                                         "<updateRate>-5</updateRate>",
                                         "<speedWindow>nan</speedWindow>", "<id>1.5</id>"));

TEST(SkidSteerEncoders, CountOnFourTopicsOfTheirOwn) {
  TestWorld world(ground_plane());
  Entity& robot = world.spawn(rover("<pulsesPR>3416</pulsesPR>"), "rover",
                              Pose::from_xyz_rpy({0, 0, 0.151}, {0, 0, 0}));
  world.run(0.5);
  world.command(robot, 0.5, 0.0);
  world.run(2.0);
  const auto& model = robot.robot->model();
  for (const auto& [topic, name] : {std::pair("fl", "fl_joint"), std::pair("fr", "fr_joint"),
                                    std::pair("rl", "rl_joint"), std::pair("rr", "rr_joint")}) {
    const auto readings =
        world.recorder().on<EncoderReading>("/ardee/encoder/" + std::string(topic));
    ASSERT_EQ(readings.size(), 125u) << topic;  // 50 Hz
    const double angle_rad =
        robot.robot->dynamics().joint_position(robot.robot->joint_index(name, model.source));
    EXPECT_NEAR(readings.back().position_rad, angle_rad, kTurn_rad / 3416.0 + 1e-6) << topic;
    EXPECT_NEAR(readings.back().speed_m_per_s, 0.5, 0.01) << topic;
  }
}

}  // namespace
}  // namespace ardee
