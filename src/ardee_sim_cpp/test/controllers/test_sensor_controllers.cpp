// SPDX-License-Identifier: MIT
#include "rig.h"

namespace ardee::control {
using namespace devices;
namespace {

TEST(SensorControllers, PublishEachSensorByItsNameAtTheRate) {
  Rig rig;
  ImuHandle& imu = rig.sensors.imus["base_imu"];
  imu.frame = "base_link";
  imu.linear_acceleration = {0, 0, 9.8};
  imu.angular_velocity = {0, 0, 0.5};
  rig.start("imu_sensor_controller/ImuSensorController", {{"publish_rate", 25.0}});
  rig.update(100);  // 1 s
  EXPECT_EQ(rig.count("/base_imu"),
            24u);  // strictly later than last + 1 / rate: the last is due at 1.01 s
  const auto& reading = rig.last<ImuReading>("/base_imu");
  EXPECT_EQ(reading.header.frame_id, "base_link");
  EXPECT_EQ(reading.linear_acceleration.z(), 9.8);
  EXPECT_EQ(reading.angular_velocity.z(), 0.5);
  EXPECT_TRUE(rig.controller->claims().empty());
}

TEST(SensorControllers, WrenchesAreMeasuredOnceSomebodyPublishesThem) {
  Rig rig;
  ForceTorqueHandle& wrist = rig.sensors.force_torques["wrist"];
  wrist.frame = "hand";
  wrist.wrench.force = {0, 0, -3};
  EXPECT_FALSE(wrist.is_wanted);
  rig.start("force_torque_sensor_controller/ForceTorqueSensorController", {{"publish_rate", 50}});
  EXPECT_TRUE(wrist.is_wanted);
  rig.update(10);
  const auto& reading = rig.last<WrenchReading>("/wrist");
  EXPECT_EQ(reading.header.frame_id, "hand");
  EXPECT_EQ(reading.wrench.force.z(), -3.0);
}

TEST(SensorControllers, NeedARate) {
  Rig rig;
  EXPECT_EQ(rig.refusal("imu_sensor_controller/ImuSensorController", {}),
            "/base/publish_rate: found nothing, expected a number");
  EXPECT_EQ(rig.refusal("force_torque_sensor_controller/ForceTorqueSensorController", {}),
            "/base/publish_rate: found nothing, expected a number");
}

}  // namespace
}  // namespace ardee::control
