// SPDX-License-Identifier: MIT
#include "rig.h"

namespace ardee::control {
using namespace devices;
namespace {

class MecanumDriveController : public testing::Test {
 protected:
  MecanumDriveController() {
    for (const std::string place : {"front_left", "back_left", "back_right", "front_right"}) {
      rig.add_joint(place, JointInterface::kVelocity);
      parameters[place + "_wheel_joint"] = place;
    }
    parameters["wheel_separation_x"] = 0.6;
    parameters["wheel_separation_y"] = 0.4;
    parameters["wheel_radius"] = 0.1;
    parameters["cmd_vel_timeout"] = 100.0;
  }
  void start() { rig.start("mecanum_drive_controller/MecanumDriveController", parameters); }
  void drive(double forward, double left, double turn) {
    rig.send("/base/cmd_vel", Twist{{forward, left, 0.0}, {0.0, 0.0, turn}});
    rig.update();
  }
  void expect_wheels(double front_left, double back_left, double back_right, double front_right) {
    EXPECT_NEAR(rig.command_of("front_left"), front_left, 1e-9);
    EXPECT_NEAR(rig.command_of("back_left"), back_left, 1e-9);
    EXPECT_NEAR(rig.command_of("back_right"), back_right, 1e-9);
    EXPECT_NEAR(rig.command_of("front_right"), front_right, 1e-9);
  }

  Rig rig;
  Parameters parameters = drive_parameters();
};

TEST_F(MecanumDriveController, TurnsEachWheelByTheInverseKinematics) {
  start();
  drive(1.0, 0.0, 0.0);
  expect_wheels(10.0, 10.0, 10.0, 10.0);
  drive(0.0, 1.0, 0.0);
  expect_wheels(-10.0, 10.0, -10.0, 10.0);
  drive(0.0, 0.0, 2.0);  // 2 rad/s times (0.6 + 0.4) / 2 m
  expect_wheels(-10.0, -10.0, 10.0, 10.0);
}

TEST_F(MecanumDriveController, MeasuresTheVelocityThatItCommands) {
  start();
  drive(0.3, -0.2, 0.5);
  rig.roll(100);
  const auto& odometry = rig.last<OdometryReading>("/base/odom");
  EXPECT_NEAR(odometry.twist.linear.x(), 0.3, 1e-9);
  EXPECT_NEAR(odometry.twist.linear.y(), -0.2, 1e-9);
  EXPECT_NEAR(odometry.twist.angular.z(), 0.5, 1e-9);
  const double yaw = 0.5 * (seconds(odometry.header.stamp_ns) - Rig::kStep_s);
  const double along = std::sin(yaw) / 0.5;
  const double across = (1.0 - std::cos(yaw)) / 0.5;
  EXPECT_NEAR(odometry.pose.p.x(), 0.3 * along + 0.2 * across, 1e-9);
  EXPECT_NEAR(odometry.pose.p.y(), 0.3 * across - 0.2 * along, 1e-9);
}

TEST_F(MecanumDriveController, TakesSizesFromTheDescription) {
  for (const char* key : {"wheel_separation_x", "wheel_separation_y", "wheel_radius"}) {
    parameters.erase(key);
  }
  rig.add_wheel("front_left", {0.5, 0.3, 0.2}, Cylinder{0.2, 0.1});
  rig.add_wheel("back_left", {-0.5, 0.3, 0.2}, Cylinder{0.2, 0.1});
  rig.add_wheel("front_right", {0.5, -0.3, 0.2}, Cylinder{0.2, 0.1});
  start();
  drive(0.0, 0.0, 1.0);  // (1.0 + 0.6) / 2 m
  expect_wheels(-4.0, -4.0, 4.0, 4.0);
}

TEST_F(MecanumDriveController, LimitsEachAxis) {
  for (const std::string axis : {"linear/x", "linear/y", "angular/z"}) {
    Parameters limited = parameters;
    parameters[axis + "/has_velocity_limits"] = true;
    parameters[axis + "/max_velocity"] = 0.1;
    start();
    drive(axis == "linear/x" ? 1.0 : 0.0, axis == "linear/y" ? 1.0 : 0.0,
          axis == "angular/z" ? 1.0 : 0.0);
    EXPECT_NEAR(rig.command_of("front_right"), axis == "angular/z" ? 0.5 : 1.0, 1e-9) << axis;
    parameters = limited;
  }
}

TEST_F(MecanumDriveController, SaysWhichWheelIsMissing) {
  parameters.erase("back_right_wheel_joint");
  EXPECT_EQ(rig.refusal("mecanum_drive_controller/MecanumDriveController", parameters),
            "/base/back_right_wheel_joint: found nothing, expected a text");
}

TEST_F(MecanumDriveController, GoesOnFromASavedState) {
  parameters["linear/x/has_acceleration_limits"] = true;
  parameters["linear/x/max_acceleration"] = 0.5;
  parameters["cmd_vel_timeout"] = 1e3;
  start();
  drive(1.0, 0.2, 0.3);
  rig.roll(50);
  rig.expect_repeats(100);
}

}  // namespace
}  // namespace ardee::control
