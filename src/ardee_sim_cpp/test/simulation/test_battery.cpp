// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fixture.h"

namespace ardee {
using namespace devices;
namespace {

const std::string kBody =
    "<robot name='r'><link name='base'><inertial><mass value='1'/>"
    "<inertia ixx='0.1' ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'/></inertial></link>";

std::string with_battery(const std::string& keys) {
  return kBody +
         "<gazebo>"
         "<plugin name='simulated_battery' filename='libardee_ros_battery.so'>"
         "<updateRate>100.0</updateRate><robotBaseFrame>base</robotBaseFrame>"
         "<batteryTopic>ardee/battery</batteryTopic><batteryLink>main_battery</batteryLink>"
         "<batteryName>5200mAh_3S_LiPo</batteryName><capacity>5.2</capacity>"
         "<initialCharge>5.2</initialCharge><vMax>16.0</vMax><vMin>2.0</vMin>"
         "<vInitial>14.0</vInitial><deltaVoltage>0.01</deltaVoltage>" +
         keys + "</plugin></gazebo></robot>";
}

std::string current_driven(const std::string& keys = "") {
  return with_battery(
      "<constantCoef>12.694</constantCoef><linearCoef>-100.1424</linearCoef>"
      "<internalResistance>0.061523</internalResistance><commandTopic>cmd_vel</commandTopic>" +
      keys);
}

TEST(Battery, QuickModeFallsByTheSameAmountEachUpdateDownToTheMinimum) {
  TestWorld world("");
  world.spawn(with_battery(""), "robot");
  world.run(5.0);
  const auto readings = world.recorder().on<BatteryReading>("/ardee/battery");
  ASSERT_EQ(readings.size(), 500u);
  EXPECT_NEAR(readings.front().voltage_V, 13.99, 1e-9);
  EXPECT_NEAR(readings.back().voltage_V, 14.0 - 500 * 0.01, 1e-9);
  EXPECT_EQ(readings.back().voltage_max_V, 16.0);
  EXPECT_EQ(readings.back().voltage_min_V, 2.0);
  EXPECT_EQ(readings.back().header.frame_id, "main_battery");
  world.run(8.0);  // 12 s would take it below
  EXPECT_EQ(world.recorder().on<BatteryReading>("/ardee/battery").back().voltage_V, 2.0);
  const auto state = world.recorder().on<BatteryStateReading>("/ardee/battery_state").back();
  EXPECT_EQ(state.percentage, 0.0);
  EXPECT_TRUE(std::isnan(state.current_A));
  EXPECT_EQ(state.location, "5200mAh_3S_LiPo");
}

TEST(Battery, CurrentDrivenModeFollowsTheLinearModel) {
  TestWorld world("");
  Entity& robot = world.spawn(
      current_driven("<smoothCurrentTau>0</smoothCurrentTau><idleCurrent>1.5</idleCurrent>"
                     "<currentPerSpeed>10</currentPerSpeed>"
                     "<currentPerYawRate>4</currentPerYawRate>"),
      "robot");
  world.command(robot, -0.5, 0.25);
  world.run(100.0);
  const double current_A = 1.5 + 10.0 * 0.5 + 4.0 * 0.25;
  const double used_Ah = current_A * 100.0 / 3600.0;
  const auto state = world.recorder().on<BatteryStateReading>("/ardee/battery_state").back();
  EXPECT_NEAR(state.current_A, -current_A, 1e-9);
  EXPECT_NEAR(state.charge_Ah, 5.2 - used_Ah, 1e-4);  // the first interval begins at idle
  EXPECT_NEAR(state.percentage, 1.0 - used_Ah / 5.2, 1e-4);
  const double ideal_V = 12.694 - 100.1424 * used_Ah / 5.2 - 0.061523 * current_A;
  EXPECT_NEAR(state.voltage_V, ideal_V, 1e-3);
}

TEST(Battery, TheCurrentFollowsACommandWithItsTimeConstant) {
  TestWorld world("");
  Entity& robot = world.spawn(
      current_driven("<smoothCurrentTau>2</smoothCurrentTau><idleCurrent>0</idleCurrent>"
                     "<currentPerSpeed>1</currentPerSpeed>"),
      "robot");
  world.command(robot, 1.0, 0.0);
  world.run(2.0);
  const auto state = world.recorder().on<BatteryStateReading>("/ardee/battery_state").back();
  EXPECT_NEAR(-state.current_A, 1.0 - std::exp(-1.0), 1e-9);
}

TEST(Battery, AnEmptyBatteryStaysAtItsMinimum) {
  TestWorld world("");
  world.spawn(current_driven("<idleCurrent>100000</idleCurrent>"), "robot");
  world.run(2.0);
  const auto state = world.recorder().on<BatteryStateReading>("/ardee/battery_state").back();
  EXPECT_EQ(state.voltage_V, 2.0);
  EXPECT_EQ(state.charge_Ah, 0.0);
}

TEST(Battery, AResetChargesIt) {
  TestWorld world("");
  world.spawn(with_battery(""), "robot");
  world.run(3.0);
  world->reset_world();
  world.run(0.01);
  const auto readings = world.recorder().on<BatteryReading>("/ardee/battery");
  EXPECT_NEAR(readings.back().voltage_V, 13.99, 1e-9);
}

class BadBattery : public testing::TestWithParam<std::string> {};

TEST_P(BadBattery, IsLeftOutAndTheRobotIsThere) {
  TestWorld world("");
  EXPECT_TRUE(world.spawn(GetParam(), "robot").devices.empty());
  EXPECT_TRUE(
      std::any_of(world.messages().begin(), world.messages().end(), [](const std::string& text) {
        return text.find("(libardee_ros_battery.so) is left out") != std::string::npos;
      }));
}

std::string battery_of(const std::string& keys) {
  return kBody +
         "<gazebo>"
         "<plugin name='b' filename='libardee_ros_battery.so'>" +
         keys + "</plugin></gazebo></robot>";
}

INSTANTIATE_TEST_SUITE_P(Values, BadBattery,
                         testing::Values(battery_of("<updateRate>0</updateRate>"),
                                         battery_of("<vMin>20</vMin>"),
                                         battery_of("<vInitial>1</vInitial>"),
                                         battery_of("<capacity>0</capacity>"),
                                         battery_of("<initialCharge>9</initialCharge>"),
                                         battery_of("<deltaVoltage>-1</deltaVoltage>")));

}  // namespace
}  // namespace ardee
