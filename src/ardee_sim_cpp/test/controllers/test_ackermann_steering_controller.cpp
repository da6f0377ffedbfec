// SPDX-License-Identifier: MIT
#include "rig.h"

namespace ardee::control {
using namespace devices;
namespace {

class AckermannSteeringController : public testing::Test {
 protected:
  AckermannSteeringController() {
    rig.add_joint("rear_wheel_joint", JointInterface::kVelocity);
    rig.add_joint("front_steer_joint", JointInterface::kPosition, JointType::kRevolute);
    parameters["wheel_separation_h"] = 2.0;
    parameters["wheel_radius"] = 0.25;
    parameters["cmd_vel_timeout"] = 100.0;
  }
  void start() {
    rig.start("ackermann_steering_controller/AckermannSteeringController", parameters);
  }
  /// Drives for 2 s at 1 m/s, with the wheel and the steering as commanded.
  const OdometryReading& drive(double steer_rad) {
    rig.drive(1.0, steer_rad);
    rig.update();
    rig.joint("front_steer_joint").position = rig.command_of("front_steer_joint");
    rig.roll(200);
    return rig.last<OdometryReading>("/base/odom");
  }

  Rig rig;
  Parameters parameters = drive_parameters();
};

TEST_F(AckermannSteeringController, SetsTheSteeringAngleAndTheWheelsSpeed) {
  parameters["wheel_radius_multiplier"] = 2.0;  // the odometry's alone
  start();
  rig.drive(1.0, 0.3);
  rig.update();
  EXPECT_NEAR(rig.command_of("rear_wheel_joint"), 4.0, 1e-12);
  EXPECT_NEAR(rig.command_of("front_steer_joint"), 0.3, 1e-12);
  rig.controller->stop(rig.now_ns);
  EXPECT_EQ(rig.command_of("rear_wheel_joint"), 0.0);
  EXPECT_EQ(rig.command_of("front_steer_joint"), 0.0);
}

TEST_F(AckermannSteeringController, TurnsOnTheCircleOfItsGeometry) {
  start();
  const OdometryReading& odometry = drive(std::atan(0.5));  // a circle of 2 m / 0.5 = 4 m
  const double yaw = (seconds(odometry.header.stamp_ns) - Rig::kStep_s) / 4.0;
  EXPECT_NEAR(odometry.pose.p.x(), 4.0 * std::sin(yaw), 1e-9);
  EXPECT_NEAR(odometry.pose.p.y(), 4.0 * (1.0 - std::cos(yaw)), 1e-9);
  EXPECT_NEAR(odometry.twist.linear.x(), 1.0, 1e-9);
  EXPECT_NEAR(odometry.twist.angular.z(), 0.25, 1e-9);
}

TEST_F(AckermannSteeringController, TakesMultipliersIntoItsOdometry) {
  parameters["wheel_separation_h_multiplier"] = 2.0;
  parameters["wheel_radius_multiplier"] = 3.0;
  parameters["steer_pos_multiplier"] = 0.5;
  start();
  const OdometryReading& odometry = drive(2.0 * std::atan(0.5));
  EXPECT_NEAR(odometry.twist.linear.x(), 3.0, 1e-9);
  EXPECT_NEAR(odometry.twist.angular.z(), 3.0 * 0.5 / 4.0, 1e-9);
}

TEST_F(AckermannSteeringController, OpenLoopFollowsTheCommand) {
  parameters["open_loop"] = true;
  start();
  rig.drive(1.0, std::atan(0.5));
  rig.update(5);
  const auto& odometry = rig.last<OdometryReading>("/base/odom");
  EXPECT_NEAR(odometry.twist.linear.x(), 1.0, 1e-12);
  EXPECT_NEAR(odometry.twist.angular.z(), 0.25, 1e-12);
}

TEST_F(AckermannSteeringController, TakesSizesFromTheDescription) {
  parameters.erase("wheel_separation_h");
  parameters.erase("wheel_radius");
  rig.add_wheel("rear_wheel_joint", {-1.0, 0.0, 0.5}, Cylinder{0.5, 0.1});
  rig.add_wheel("front_steer_joint", {3.0, 1.0, 0.7}, Box{});
  start();
  const OdometryReading& odometry = drive(std::atan(0.5));
  EXPECT_NEAR(rig.command_of("rear_wheel_joint"), 2.0, 1e-12);
  EXPECT_NEAR(odometry.twist.angular.z(), 0.5 / 4.0, 1e-9);
  rig.model.links[0].collisions[0].geometry = Sphere{0.5};
  EXPECT_EQ(rig.refusal("ackermann_steering_controller/AckermannSteeringController", parameters),
            "/base/wheel_radius: found nothing, and link 'rear_wheel_joint_link' has no collision "
            "of a cylinder to take it from");
}

TEST_F(AckermannSteeringController, LimitsSpeedAndSteering) {
  parameters["linear/x/has_velocity_limits"] = true;
  parameters["linear/x/max_velocity"] = 0.5;
  parameters["angular/z/has_velocity_limits"] = true;
  parameters["angular/z/max_velocity"] = 0.2;
  start();
  rig.drive(1.0, -1.0);
  rig.update();
  EXPECT_NEAR(rig.command_of("rear_wheel_joint"), 2.0, 1e-12);
  EXPECT_NEAR(rig.command_of("front_steer_joint"), -0.2, 1e-12);
}

TEST_F(AckermannSteeringController, GoesOnFromASavedState) {
  parameters["cmd_vel_timeout"] = 1e3;
  parameters["linear/x/has_acceleration_limits"] = true;
  parameters["linear/x/max_acceleration"] = 0.5;
  start();
  rig.drive(1.0, 0.3);
  rig.roll(50);
  rig.expect_repeats(100);
}

}  // namespace
}  // namespace ardee::control
