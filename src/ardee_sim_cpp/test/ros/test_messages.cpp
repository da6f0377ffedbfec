// SPDX-License-Identifier: MIT
// Tests of readings as ROS messages, and of the log messages that reach a service's caller.
#include <gtest/gtest.h>

#include <cmath>

#include "ros/message_tap.h"
#include "ros/reading_to_message.h"

namespace ardee::node {
using namespace devices;
namespace {

TEST(Messages, OdometryHasBothCovariancesOnTheDiagonal) {
  OdometryReading reading;
  reading.pose_covariance = {1, 2, 3, 4, 5, 6};
  reading.twist_covariance = {7, 8, 9, 10, 11, 12};
  const nav_msgs::Odometry message = to_message(reading);
  for (std::size_t i = 0; i < 36; ++i) {
    const std::size_t row = i / 6;
    const bool on_diagonal = i % 7 == 0;
    EXPECT_EQ(message.pose.covariance[i], on_diagonal ? reading.pose_covariance[row] : 0.0);
    EXPECT_EQ(message.twist.covariance[i], on_diagonal ? reading.twist_covariance[row] : 0.0);
  }
}

TEST(Messages, AScanTellsItsTimes) {
  LidarReading reading;
  reading.scan_time_s = 0.025;
  reading.time_increment_s = 1.5e-5;
  const sensor_msgs::LaserScan message = to_message(reading);
  EXPECT_EQ(message.scan_time, 0.025f);
  EXPECT_EQ(message.time_increment, 1.5e-5f);
}

TEST(Messages, OnlyAFixHasAKnownCovariance) {
  FixReading reading;
  reading.covariance = {1, 2, 3};
  for (const int status : {0, 1, 2}) {
    reading.status = status;
    const sensor_msgs::NavSatFix fix = to_message(reading);
    EXPECT_EQ(fix.position_covariance_type, sensor_msgs::NavSatFix::COVARIANCE_TYPE_DIAGONAL_KNOWN);
    EXPECT_EQ(fix.position_covariance[4], 2.0);
  }
  reading.status = -1;
  const sensor_msgs::NavSatFix none = to_message(reading);
  EXPECT_EQ(none.status.status, sensor_msgs::NavSatStatus::STATUS_NO_FIX);
  EXPECT_EQ(none.position_covariance_type, sensor_msgs::NavSatFix::COVARIANCE_TYPE_UNKNOWN);
  for (const double element : none.position_covariance) EXPECT_EQ(element, 0.0);
}

TEST(Messages, ABatteryDoesNotMeasureItsTemperature) {
  BatteryStateReading reading;
  reading.current_A = -2.0;
  const sensor_msgs::BatteryState message = to_message(reading);
  EXPECT_TRUE(std::isnan(message.temperature));
  EXPECT_EQ(message.power_supply_status,
            sensor_msgs::BatteryState::POWER_SUPPLY_STATUS_DISCHARGING);
  EXPECT_TRUE(message.present);
}

TEST(Messages, WarningsAreKeptWhileSomebodyWantsThem) {
  int passed = 0;
  MessageTap tap([&passed](LogLevel, const std::string&) { ++passed; });
  const LogSink sink = tap.sink();
  sink(LogLevel::kWarning, "before");
  {
    const MessageTap::Kept kept(tap);
    sink(LogLevel::kInfo, "chatter");
    sink(LogLevel::kWarning, "first");
    sink(LogLevel::kError, "second");
    EXPECT_EQ(kept.texts(), (std::vector<std::string>{"first", "second"}));
  }
  sink(LogLevel::kWarning, "after");
  const MessageTap::Kept again(tap);
  EXPECT_TRUE(again.texts().empty());
  EXPECT_EQ(passed, 5);
}

}  // namespace
}  // namespace ardee::node
