// SPDX-License-Identifier: MIT
#include "rig.h"

namespace ardee::control {
using namespace devices;
namespace {

class FourWheelSteeringController : public testing::Test {
 protected:
  FourWheelSteeringController() {
    for (const std::string axle : {"f", "r"}) {
      for (const std::string side : {"l", "r"}) {
        rig.add_joint(axle + side, JointInterface::kVelocity);
        rig.add_joint(axle + side + "_steer", JointInterface::kPosition);
      }
    }
    place_wheels(0.0);
    parameters["front_wheel"] = names({"fl", "fr"});
    parameters["rear_wheel"] = names({"rl", "rr"});
    parameters["front_steering"] = names({"fl_steer", "fr_steer"});
    parameters["rear_steering"] = names({"rl_steer", "rr_steer"});
    parameters["cmd_vel_timeout"] = 100.0;
  }
  /// Places steering axes 2 m apart in both directions, and wheels of 0.5 m outside of them by the
  /// offset.
  void place_wheels(double offset_m) {
    rig.model = {};
    for (const double x : {1.0, -1.0}) {
      for (const double side : {1.0, -1.0}) {
        const std::string name = std::string(x > 0.0 ? "f" : "r") + (side > 0.0 ? "l" : "r");
        rig.add_wheel(name + "_steer", {x, side, 0.8}, Box{});
        rig.add_wheel(name, {x, side * (1.0 + offset_m), 0.5}, Cylinder{0.5, 0.1});
      }
    }
  }
  void start() {
    rig.start("four_wheel_steering_controller/FourWheelSteeringController", parameters);
  }
  void steer(double front_rad, double rear_rad, double speed_m_per_s) {
    rig.send("/base/cmd_four_wheel_steering", SteeringCommand{front_rad, rear_rad, speed_m_per_s});
  }
  void expect_wheels(const std::vector<double>& rates, const std::vector<double>& angles) {
    const std::vector<std::string> order = {"fl", "fr", "rl", "rr"};
    for (std::size_t i = 0; i < order.size(); ++i) {
      EXPECT_NEAR(rig.command_of(order[i]), rates[i], 1e-9) << order[i];
      EXPECT_NEAR(rig.command_of(order[i] + "_steer"), angles[i], 1e-9) << order[i];
    }
  }
  /// Lets the wheels follow their commands for a second.
  const OdometryReading& follow() {
    rig.update();
    for (auto& [name, joint] : rig.hardware) {
      if (joint.interface == JointInterface::kPosition) joint.position = joint.command;
    }
    rig.roll(100);
    return rig.last<OdometryReading>("/base/odom");
  }

  Rig rig;
  Parameters parameters = drive_parameters();
};

TEST_F(FourWheelSteeringController, DrivesStraight) {
  start();
  rig.drive(1.0, 0.0);
  rig.update();
  expect_wheels({2.0, 2.0, 2.0, 2.0}, {0.0, 0.0, 0.0, 0.0});
}

TEST_F(FourWheelSteeringController, TurnsAboutAPointBesideIt) {
  start();
  rig.drive(2.0, 1.0);  // about 2 m to the left: its wheels 1 and 3 m from there, 1 m ahead
  rig.update();
  const double near = std::sqrt(2.0) / 0.5;
  const double far = std::sqrt(10.0) / 0.5;
  expect_wheels({near, far, near, far},
                {kPi / 4.0, std::atan(1.0 / 3.0), -kPi / 4.0, -std::atan(1.0 / 3.0)});
}

TEST_F(FourWheelSteeringController, DrivesBackwardsOnTheSameCircle) {
  start();
  rig.drive(-2.0, -1.0);
  rig.update();
  const double near = std::sqrt(2.0) / 0.5;
  const double far = std::sqrt(10.0) / 0.5;
  expect_wheels({-near, -far, -near, -far},
                {kPi / 4.0, std::atan(1.0 / 3.0), -kPi / 4.0, -std::atan(1.0 / 3.0)});
}

TEST_F(FourWheelSteeringController, CountsTheWheelsOffsetFromTheSteeringAxis) {
  place_wheels(0.25);
  start();
  rig.drive(2.0, 1.0);
  rig.update();
  const double near = (std::sqrt(2.0) - 0.25) / 0.5;
  const double far = (std::sqrt(10.0) + 0.25) / 0.5;
  expect_wheels({near, far, near, far},
                {kPi / 4.0, std::atan(1.0 / 3.0), -kPi / 4.0, -std::atan(1.0 / 3.0)});
}

TEST_F(FourWheelSteeringController, StandsAcrossWhereItTurnsWithinItsTrack) {
  start();
  rig.drive(0.5, 1.0);
  rig.update();
  const double near = std::hypot(0.5, 1.0) / 0.5;
  const double far = std::hypot(1.5, 1.0) / 0.5;
  expect_wheels({near, far, near, far}, {kPi / 2.0, kPi / 2.0, -kPi / 2.0, -kPi / 2.0});
  rig.drive(0.0, 1.0);
  rig.update();
  expect_wheels({0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0});
}

TEST_F(FourWheelSteeringController, SteersByVirtualAngles) {
  start();
  steer(std::atan(0.5), -std::atan(0.5), 2.0);  // the circle of 2 m/s and 1 rad/s
  rig.update();
  const double near = std::sqrt(2.0) / 0.5;
  const double far = std::sqrt(10.0) / 0.5;
  expect_wheels({near, far, near, far},
                {kPi / 4.0, std::atan(1.0 / 3.0), -kPi / 4.0, -std::atan(1.0 / 3.0)});
  steer(0.4, 0.4, 1.0);  // sideways, all wheels alike
  rig.update();
  expect_wheels({2.0, 2.0, 2.0, 2.0}, {0.4, 0.4, 0.4, 0.4});
}

TEST_F(FourWheelSteeringController, FollowsTheNewestCommandOfBothTopics) {
  start();
  rig.drive(1.0, 0.0);
  steer(0.0, 0.0, 2.0);
  rig.update();
  EXPECT_NEAR(rig.command_of("fl"), 4.0, 1e-12);
  rig.drive(1.0, 0.0);
  rig.update();
  EXPECT_NEAR(rig.command_of("fl"), 2.0, 1e-12);
}

TEST_F(FourWheelSteeringController, MeasuresTheVelocityThatItCommands) {
  for (const double offset_m : {0.0, 0.25}) {
    place_wheels(offset_m);
    start();
    rig.drive(2.0, 1.0);
    const OdometryReading& odometry = follow();
    EXPECT_NEAR(odometry.twist.linear.x(), 2.0, 1e-9);
    EXPECT_NEAR(odometry.twist.linear.y(), 0.0, 1e-9);
    EXPECT_NEAR(odometry.twist.angular.z(), 1.0, 1e-9);
    EXPECT_EQ(odometry.header.frame_id, "odom");
  }
}

TEST_F(FourWheelSteeringController, MeasuresAMotionSideways) {
  start();
  steer(0.4, 0.4, 1.0);
  const OdometryReading& odometry = follow();
  EXPECT_NEAR(odometry.twist.linear.x(), std::cos(0.4), 1e-9);
  EXPECT_NEAR(odometry.twist.linear.y(), std::sin(0.4), 1e-9);
  EXPECT_NEAR(odometry.twist.angular.z(), 0.0, 1e-9);
}

TEST_F(FourWheelSteeringController, PublishesHowItIsSteered) {
  parameters["velocity_rolling_window_size"] = 1;
  start();
  steer(std::atan(0.5), -std::atan(0.5), 2.0);
  follow();
  const auto& state = rig.last<FourWheelSteeringReading>("/base/odom_steer");
  EXPECT_NEAR(state.front_angle_rad, std::atan(0.5), 1e-9);
  EXPECT_NEAR(state.rear_angle_rad, -std::atan(0.5), 1e-9);
  EXPECT_NEAR(state.front_rate_rad_per_s, 0.0, 1e-9);
  EXPECT_NEAR(state.speed_m_per_s, 2.0, 1e-9);
  EXPECT_NEAR(state.acceleration_m_per_s2, 0.0, 1e-6);
  for (const char* wheel : {"fl", "fr", "rl", "rr"}) rig.joint(wheel).velocity *= 1.5;
  rig.readings.clear();
  rig.update();
  const bool is_due = rig.count("/base/odom_steer") > 0;
  if (!is_due) {  // the change appears in its own step only
    for (const char* wheel : {"fl", "fr", "rl", "rr"}) rig.joint(wheel).velocity *= 4.0 / 3.0;
    rig.update();
  }
  const auto& changed = rig.last<FourWheelSteeringReading>("/base/odom_steer");
  EXPECT_NEAR(changed.acceleration_m_per_s2, 1.0 / Rig::kStep_s, 1e-6);
}

TEST_F(FourWheelSteeringController, SaysWhichParameterIsWrong) {
  parameters["rear_wheel"] = names({"rl"});
  EXPECT_EQ(rig.refusal("four_wheel_steering_controller/FourWheelSteeringController", parameters),
            "/base/rear_wheel: found 1 joints, expected 2, left and right");
}

TEST_F(FourWheelSteeringController, GoesOnFromASavedState) {
  parameters["linear/x/has_acceleration_limits"] = true;
  parameters["linear/x/max_acceleration"] = 0.5;
  start();
  steer(0.2, -0.1, 1.0);
  rig.roll(50);
  rig.expect_repeats(100);
}

}  // namespace
}  // namespace ardee::control
