// SPDX-License-Identifier: MIT
#include "rig.h"

namespace ardee::control {
using namespace devices;
namespace {

class DiffDriveController : public testing::Test {
 protected:
  DiffDriveController() {
    for (const char* name : {"l1", "l2", "r1", "r2"}) {
      rig.add_joint(name, JointInterface::kVelocity);
    }
    parameters = drive_parameters();
    parameters["left_wheel"] = names({"l1", "l2"});
    parameters["right_wheel"] = names({"r1", "r2"});
    parameters["wheel_separation"] = 0.5;
    parameters["wheel_radius"] = 0.1;
  }
  void start() { rig.start("diff_drive_controller/DiffDriveController", parameters); }
  std::string refusal() {
    return rig.refusal("diff_drive_controller/DiffDriveController", parameters);
  }
  const OdometryReading& odometry() { return rig.last<OdometryReading>("/base/odom"); }
  void expect_wheels(double left, double right) {
    EXPECT_NEAR(rig.command_of("l1"), left, 1e-9);
    EXPECT_NEAR(rig.command_of("l2"), left, 1e-9);
    EXPECT_NEAR(rig.command_of("r1"), right, 1e-9);
    EXPECT_NEAR(rig.command_of("r2"), right, 1e-9);
  }

  Rig rig;
  Parameters parameters;
};

TEST_F(DiffDriveController, TurnsTheWheelsOfEachSideAlike) {
  start();
  rig.drive(0.3, 0.4);
  rig.update();
  expect_wheels((0.3 - 0.1) / 0.1, (0.3 + 0.1) / 0.1);
  EXPECT_EQ(rig.controller->claims().at(JointInterface::kVelocity),
            (std::set<std::string>{"l1", "l2", "r1", "r2"}));
}

TEST_F(DiffDriveController, MeasuresRadiusTimesTheMeanAngleOfASide) {
  start();
  rig.joint("l1").position = rig.joint("r1").position = 1.0;
  rig.joint("l2").position = rig.joint("r2").position = 3.0;
  rig.update(3);
  EXPECT_NEAR(odometry().pose.p.x(), 0.2, 1e-12);
  EXPECT_NEAR(odometry().pose.p.y(), 0.0, 1e-12);
}

TEST_F(DiffDriveController, FollowsAnArcOfItsVelocities) {
  parameters["cmd_vel_timeout"] = 1e3;
  start();
  rig.drive(0.5, 0.25);  // a circle of 2 m
  rig.update();
  rig.roll(200);  // 2 s; the last reading is at most 20 ms old
  const double time_s = seconds(odometry().header.stamp_ns) - Rig::kStep_s;
  const double yaw = 0.25 * time_s;
  EXPECT_NEAR(odometry().pose.p.x(), 2.0 * std::sin(yaw), 1e-9);
  EXPECT_NEAR(odometry().pose.p.y(), 2.0 * (1.0 - std::cos(yaw)), 1e-9);
  EXPECT_NEAR(rpy_from_quaternion(odometry().pose.q).z(), yaw, 1e-9);
  EXPECT_NEAR(odometry().twist.linear.x(), 0.5, 1e-9);
  EXPECT_NEAR(odometry().twist.angular.z(), 0.25, 1e-9);
  const auto& transform = rig.last<TransformReading>("/tf");
  EXPECT_EQ(transform.header.frame_id, "odom");
  EXPECT_EQ(transform.child_frame_id, "base_link");
  EXPECT_EQ(transform.pose.p, odometry().pose.p);
  EXPECT_TRUE(transform.in_odometry_frame);
}

TEST_F(DiffDriveController, StopsAfterTheTimeoutToTheStep) {
  parameters["cmd_vel_timeout"] = 0.25;
  start();
  rig.drive(0.1, 0.0);
  rig.update(26);  // the age is 0 at the first, 0.25 s at the last
  expect_wheels(1.0, 1.0);
  rig.update();
  expect_wheels(0.0, 0.0);
}

TEST_F(DiffDriveController, BrakesThroughTheLimiter) {
  parameters["linear/x/has_acceleration_limits"] = true;
  parameters["linear/x/max_acceleration"] = 1.0;
  parameters["cmd_vel_timeout"] = 0.05;
  start();
  rig.drive(1.0, 0.0);
  rig.update(6);
  expect_wheels(0.6, 0.6);  // 6 steps of 0.01 m/s
  rig.update();
  expect_wheels(0.5, 0.5);
}

TEST_F(DiffDriveController, PublishesOnceAPeriodAfterItsStart) {
  start();
  rig.update(2);  // 20 ms are not more than a period of 50 Hz
  EXPECT_EQ(rig.count("/base/odom"), 0u);
  rig.update();
  EXPECT_EQ(rig.count("/base/odom"), 1u);
  rig.update(198);
  EXPECT_EQ(rig.count("/base/odom"), 100u);
  EXPECT_EQ(rig.count("/tf"), 100u);
}

TEST_F(DiffDriveController, OpenLoopFollowsTheCommandNotTheWheels) {
  parameters["open_loop"] = true;
  start();
  rig.drive(0.5, 0.0);
  rig.update(11);  // the wheels stand
  EXPECT_NEAR(odometry().pose.p.x(), 0.5 * 0.1, 1e-12);
  EXPECT_NEAR(odometry().twist.linear.x(), 0.5, 1e-12);
}

TEST_F(DiffDriveController, TakesSizesTimesTheirMultipliers) {
  parameters["wheel_separation_multiplier"] = 2.0;
  parameters["left_wheel_radius_multiplier"] = 0.5;
  parameters["right_wheel_radius_multiplier"] = 2.0;
  start();
  rig.drive(0.3, 0.4);
  rig.update();
  expect_wheels((0.3 - 0.2) / 0.05, (0.3 + 0.2) / 0.2);
  parameters["wheel_radius_multiplier"] = 4.0;  // for both, instead of their own
  start();
  rig.drive(0.3, 0.4);
  rig.update();
  expect_wheels((0.3 - 0.2) / 0.4, (0.3 + 0.2) / 0.4);
}

TEST_F(DiffDriveController, TakesSizesFromTheDescription) {
  parameters.erase("wheel_separation");
  parameters.erase("wheel_radius");
  EXPECT_EQ(refusal(),
            "/base/wheel_separation: found nothing, and no joint 'l1' in the robot's description "
            "to take it from");
  rig.add_wheel("l1", {0.2, 0.3, 0.1}, Sphere{0.2});
  rig.add_wheel("r1", {0.2, -0.3, 0.1}, Box{});
  start();
  rig.drive(0.3, 0.5);
  rig.update();
  expect_wheels((0.3 - 0.15) / 0.2, (0.3 + 0.15) / 0.2);
  rig.model.links[0].collisions[0].geometry = Box{};
  EXPECT_EQ(refusal(),
            "/base/wheel_radius: found nothing, and link 'l1_link' has no collision of a cylinder "
            "or a sphere to take it from");
}

TEST_F(DiffDriveController, PublishesItsCommandAndItsWheelsWhenAsked) {
  start();
  EXPECT_FALSE(rig.publishes("/base/cmd_vel_out"));
  EXPECT_FALSE(rig.publishes("/base/wheel_joint_controller_state"));
  parameters["publish_cmd"] = true;
  parameters["publish_wheel_joint_controller_state"] = true;
  parameters["linear/x/has_velocity_limits"] = true;
  parameters["linear/x/max_velocity"] = 0.2;
  start();
  rig.joint("r2").position = 5.0;
  rig.joint("r2").velocity = 1.0;
  rig.joint("r2").effort = 7.0;
  rig.drive(9.0, 0.0);
  rig.update();
  EXPECT_EQ(rig.last<TwistReading>("/base/cmd_vel_out").twist.linear.x(), 0.2);
  const auto& state = rig.last<TrajectoryControllerReading>("/base/wheel_joint_controller_state");
  EXPECT_EQ(state.names, (std::vector<std::string>{"l1", "l2", "r1", "r2"}));
  EXPECT_NEAR(state.desired.velocities[3], 2.0, 1e-12);
  EXPECT_NEAR(state.desired.positions[3], 0.02, 1e-12);
  EXPECT_EQ(state.actual.positions[3], 5.0);
  EXPECT_EQ(state.actual.velocities[3], 1.0);
  EXPECT_NEAR(state.actual.accelerations[3], 100.0, 1e-9);
  EXPECT_EQ(state.actual.efforts[3], 7.0);
  EXPECT_NEAR(state.error.velocities[3], 1.0, 1e-12);
  EXPECT_NEAR(state.error.positions[3], -4.98, 1e-12);
}

TEST_F(DiffDriveController, NamesFramesAndCovariancesAsGiven) {
  parameters["base_frame_id"] = std::string("base_footprint");
  parameters["odom_frame_id"] = std::string("map_odom");
  parameters["enable_odom_tf"] = false;
  Setting::List diagonal;
  for (int i = 0; i < 6; ++i) diagonal.push_back({"", 0.5 * i});
  parameters["pose_covariance_diagonal"] = diagonal;
  start();
  rig.update(3);
  EXPECT_EQ(odometry().header.frame_id, "map_odom");
  EXPECT_EQ(odometry().child_frame_id, "base_footprint");
  EXPECT_EQ(odometry().pose_covariance[5], 2.5);
  EXPECT_EQ(odometry().twist_covariance[5], 0.0);
  EXPECT_EQ(rig.count("/tf"), 0u);
}

TEST_F(DiffDriveController, MayBeTunedWhileItRunsUntilAReset) {
  start();
  rig.tunable("wheel_separation_multiplier").set(1.5);
  rig.tunable("left_wheel_radius_multiplier").set(0.5);
  rig.tunable("enable_odom_tf").set(0.0);
  rig.tunable("publish_rate").set(100.0);
  rig.drive(0.3, 0.4);
  rig.update(21);
  expect_wheels((0.3 - 0.15) / 0.05, (0.3 + 0.15) / 0.1);
  EXPECT_EQ(rig.count("/tf"), 0u);
  EXPECT_EQ(rig.count("/base/odom"), 20u);
  EXPECT_EQ(rig.controller->ports().all<ParameterGroup>()[0].get().name, "/base");
  rig.controller->reset(rig.now_ns);
  EXPECT_EQ(rig.tunable("wheel_separation_multiplier").get(), 1.0);
  EXPECT_EQ(rig.tunable("publish_rate").get(), 50.0);
}

TEST_F(DiffDriveController, AsksForOnePublisherWhereItIsTold) {
  start();
  EXPECT_FALSE(rig.controller->ports().all<Input>()[0].get().needs_one_publisher);
  parameters["allow_multiple_cmd_vel_publishers"] = false;
  start();
  EXPECT_TRUE(rig.controller->ports().all<Input>()[0].get().needs_one_publisher);
}

TEST_F(DiffDriveController, TakesNoCommandWhileItStandsOrThatIsNotFinite) {
  rig.make("diff_drive_controller/DiffDriveController", parameters);
  EXPECT_EQ(message_of([&] { rig.drive(1.0, 0.0); }),
            "found a command while the controller is not running");
  start();
  EXPECT_EQ(message_of([&] { rig.drive(NAN, 0.0); }), "found a command that is not finite");
  rig.update();
  expect_wheels(0.0, 0.0);
}

TEST_F(DiffDriveController, StandsWhenStoppedAndKeepsItsPoseWhenStartedAgain) {
  start();
  rig.drive(0.5, 0.0);
  rig.update();
  rig.roll(20);
  const double x = odometry().pose.p.x();
  EXPECT_GT(x, 0.08);
  rig.controller->stop(rig.now_ns);
  expect_wheels(0.0, 0.0);
  rig.controller->start(rig.now_ns);
  rig.update(4);
  EXPECT_NEAR(odometry().pose.p.x(), x, 0.02);
  expect_wheels(0.0, 0.0);
  rig.controller->reset(rig.now_ns);
  for (auto& [name, joint] : rig.hardware) joint.position = 0.0;
  rig.controller->start(rig.now_ns);
  rig.update(4);
  EXPECT_EQ(odometry().pose.p.x(), 0.0);
}

TEST_F(DiffDriveController, SaysWhichParameterIsWrong) {
  const Parameters right = parameters;
  const auto with = [&](const std::string& key, const Setting::Value& value) {
    parameters = right;
    parameters[key] = value;
    return refusal();
  };
  EXPECT_EQ(with("left_wheel", {}), "/base/left_wheel: found nothing, expected a list of names");
  EXPECT_EQ(with("left_wheel", std::string("l1")),
            "/base: found a left_wheel list of 1 and a right_wheel list of 2, expected as many on "
            "each side");
  EXPECT_EQ(with("left_wheel", names({})),
            "/base/left_wheel: found an empty list, expected names of joints");
  EXPECT_EQ(with("left_wheel", names({"l1", "no"})),
            "/base/left_wheel: found joint 'no', expected one that a transmission names");
  EXPECT_EQ(with("wheel_radius", -0.1),
            "/base/wheel_radius: found -0.100000, expected a number above 0");
  EXPECT_EQ(with("wheel_separation_multiplier", 0.0),
            "/base/wheel_separation_multiplier: found 0, expected another");
  EXPECT_EQ(with("velocity_rolling_window_size", 0),
            "/base/velocity_rolling_window_size: found 0, expected at least 1");
  EXPECT_EQ(with("pose_covariance_diagonal", {}),
            "/base/pose_covariance_diagonal: found nothing, expected a list of 6 numbers");
  EXPECT_EQ(with("unknown_key", 1.0), "no error");
  rig.add_joint("effort", JointInterface::kEffort);
  EXPECT_EQ(with("left_wheel", names({"l1", "effort"})),
            "/base/left_wheel: joint 'effort' has the hardware_interface::EffortJointInterface, "
            "expected the hardware_interface::VelocityJointInterface");
}

TEST_F(DiffDriveController, GoesOnFromASavedState) {
  parameters["cmd_vel_timeout"] = 1e3;
  parameters["linear/x/has_acceleration_limits"] = true;
  parameters["linear/x/max_acceleration"] = 0.5;
  start();
  rig.tunable("left_wheel_radius_multiplier").set(1.1);
  rig.drive(1.0, 0.3);
  rig.roll(50);
  rig.expect_repeats(100);
}

}  // namespace
}  // namespace ardee::control
