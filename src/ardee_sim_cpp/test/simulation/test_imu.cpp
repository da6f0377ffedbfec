// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "motion_rig.h"

namespace ardee {
using namespace devices;
namespace {

using Eigen::Vector3d;

constexpr double kG = 9.81;
constexpr double kRightAngle = 1.5707963267948966;

std::string hector(const std::string& keys) { return plugin("hector_gazebo_ros_imu", keys); }

/// Returns all IMU readings of a run.
std::vector<ImuReading> imu(TestWorld& world, const std::string& topic = "/imu") {
  std::vector<ImuReading> readings = world.recorder().on<ImuReading>(topic);
  EXPECT_FALSE(readings.empty());
  return readings;
}

void spin(TestWorld& world, const Vector3d& linear, const Vector3d& angular) {
  world->set_state("ball", {Pose{}, {linear, angular}}, "world");
}

TEST(Imu, at_rest_feels_gravity_exactly) {
  TestWorld world(free_space(-kG));
  world.spawn(still(hector("")), "ball");
  world.run(0.1);
  ASSERT_EQ(imu(world).size(), 100u);  // no rate: each step
  for (const ImuReading& reading : imu(world)) {
    EXPECT_EQ(reading.linear_acceleration, Vector3d(0, 0, kG));
    EXPECT_EQ(reading.angular_velocity, Vector3d::Zero());
  }
  EXPECT_EQ(imu(world)[0].header.frame_id, "body");
}

TEST(Imu, at_rest_on_the_ground_from_the_first_sample_after_settling) {
  const std::string box =
      "<sdf version='1.6'><model name='box'><pose>0 0 0.1 0 0 0</pose><link name='body'><inertial>"
      "<mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>"
      "<collision name='c'><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>"
      "</link>" +
      hector("<updateRate>50</updateRate>") + "</model></sdf>";
  TestWorld world(free_space(-kG) + ground_plane());
  world.spawn(box, "box");
  world.run(1.0);
  world.recorder().clear();
  world.run(0.5);
  for (const ImuReading& reading : imu(world)) {
    expect_near(reading.linear_acceleration, {0, 0, kG}, 1e-3);
    expect_near(reading.angular_velocity, Vector3d::Zero(), 1e-4);
  }
}

TEST(Imu, any_mounting_feels_gravity_along_its_own_axes) {
  // Signs are Gazebo's: roll gives +g sin(roll) on y, pitch -g sin(pitch) on x.
  const double roll = 0.3, pitch = -0.4;
  const struct {
    std::string keys;
    Pose pose;
    Vector3d expected;
  } cases[] = {
      {"",
       Pose::from_xyz_rpy({0, 0, 0}, {roll, 0, 0}),
       {0, kG * std::sin(roll), kG * std::cos(roll)}},
      {"",
       Pose::from_xyz_rpy({0, 0, 0}, {0, pitch, 0}),
       {-kG * std::sin(pitch), 0, kG * std::cos(pitch)}},
      {"<bodyName>nose</bodyName>", {}, {0, kG, 0}},
      {"<rpyOffset>0 1.5707963267948966 0</rpyOffset>", {}, {-kG, 0, 0}},
  };
  for (const auto& each : cases) {
    TestWorld world(free_space(-kG));
    world.spawn(still(hector(each.keys)), "ball", each.pose);
    world.run(0.01);
    expect_near(imu(world).back().linear_acceleration, each.expected, 1e-12);
  }
}

TEST(Imu, free_fall_feels_nothing_from_the_first_sample) {
  for (const double step_s : {0.001, 0.005}) {
    TestWorld world(free_space(-kG), step_s);
    world.spawn(ball(hector("<bodyName>nose</bodyName>")), "ball",
                Pose::from_xyz_rpy({30, -20, 100}, {0.3, 0.2, 0.1}));
    world.run(0.5);
    for (const ImuReading& reading : imu(world)) {
      expect_near(reading.linear_acceleration, Vector3d::Zero(), 1e-6);
    }
  }
}

TEST(Imu, on_a_circle_feels_the_centripetal_acceleration) {
  for (const double step_s : {0.001, 0.005}) {
    for (const double turn : {0.5, 5.0}) {
      TestWorld world(free_space(0.0), step_s);
      world.spawn(ball(hector("<bodyName>nose</bodyName>") +
                       plugin("hector_gazebo_ros_imu",
                              "<topicName>tilted</topicName><xyzOffset>0 2 0</xyzOffset>"
                              "<rpyOffset>0 0 1.5707963267948966</rpyOffset>",
                              "tilted")),
                  "ball");
      spin(world, {0, 0, 0}, {0, 0, turn});
      world.run(0.2);
      const double share = 1e-4 + std::pow(turn * step_s, 2);  // the integrator's turn
      world.recorder().clear();
      world.run(0.5);
      for (const ImuReading& reading : imu(world)) {
        // The sensor is 1 m in front; its own y points up, its z to the right.
        expect_near(reading.linear_acceleration, {-turn * turn, 0, 0}, turn * turn * share);
        expect_near(reading.angular_velocity, {0, turn, 0}, turn * share);
      }
      for (const ImuReading& reading : imu(world, "/tilted")) {
        // The sensor is 2 m to the left; x points there.
        expect_near(reading.linear_acceleration, {-2 * turn * turn, 0, 0}, 2 * turn * turn * share);
        expect_near(reading.angular_velocity, {0, 0, turn}, turn * share);
      }
    }
  }
}

TEST(Imu, a_torque_is_felt_along_the_lever_arm) {
  const double step_s = 0.005, alpha = 0.8;  // 1 kg m^2: rad/s^2 as N m
  TestWorld world(free_space(0.0), step_s);
  Entity& robot = world.spawn(ball(hector("<bodyName>nose</bodyName>")), "ball");
  double turn = 0.0;
  for (int i = 0; i < 100; ++i) {
    robot.robot->dynamics().apply_wrench(0, Vector3d::Zero(), Vector3d::Zero(), {0, 0, alpha});
    world->step();
    const ImuReading reading = imu(world).back();
    // The tangent points to the left, which is -z of the nose; the velocity is that of the step's
    // begin.
    if (i > 1) {
      expect_near(reading.linear_acceleration, {-turn * turn, 0, -alpha}, 0.01 * alpha);
    }
    turn += alpha * step_s;
  }
}

TEST(Imu, a_wheel_on_a_hinge_at_constant_speed) {
  const std::string wheel =
      "<sdf version='1.6'><model name='ball'><link name='hub'><inertial><mass>1</mass></inertial>"
      "</link><joint name='foot' type='fixed'><parent>world</parent><child>hub</child></joint>"
      "<link name='arm'><inertial><pose>0.5 0 0 0 0 0</pose><mass>1</mass></inertial></link>"
      "<joint name='hinge' type='revolute'><parent>hub</parent><child>arm</child><axis><xyz>0 0 1"
      "</xyz></axis></joint>" +
      hector("<bodyName>arm</bodyName><xyzOffset>1 0 0</xyzOffset><updateRate>50</updateRate>") +
      "</model></sdf>";
  const double turn = 2.0;
  TestWorld world(free_space(-kG), 0.005);
  Entity& robot = world.spawn(wheel, "ball");
  robot.robot->dynamics().set_joint_motor(robot.robot->joint_index("hinge", {}), turn, 1000.0);
  world.run(2.0);
  world.recorder().clear();
  world.run(1.0);
  ASSERT_EQ(imu(world).size(), 50u);
  for (const ImuReading& reading : imu(world)) {
    expect_near(reading.linear_acceleration, {-turn * turn, 0, kG}, 0.02 * turn * turn);
    expect_near(reading.angular_velocity, {0, 0, turn}, 0.002 * turn);
  }
}

TEST(Imu, no_spike_when_it_begins_moves_or_is_reset) {
  TestWorld world(free_space(-kG), 0.005);
  const Pose leaning = Pose::from_xyz_rpy({5, 5, 5}, {0.5, -0.5, 2.0});
  world.spawn(ball(hector("")), "ball", leaning);
  world.run(0.05);
  world->set_state("ball", {Pose::from_xyz_rpy({-300, 40, 9}, {1, 1, 1}), {{3, 2, 1}, {0, 0, 0}}},
                   "world");
  world.run(0.05);
  world->reset_world();
  world.run(0.05);
  for (const ImuReading& reading : imu(world)) {
    expect_near(reading.linear_acceleration, Vector3d::Zero(), 1e-6);
    expect_near(reading.angular_velocity, Vector3d::Zero(), 1e-9);
  }
}

TEST(Imu, rate_integrates_to_the_turn) {
  const double step_s = 0.005;
  TestWorld world(free_space(0.0), step_s);
  world.spawn(ball(hector("<updateRate>40</updateRate>")), "ball");
  spin(world, {0, 0, 0}, {0, 0, 1.0});
  world.run(1.0);
  double turned = 0.0;
  for (const ImuReading& reading : imu(world)) turned += reading.angular_velocity.z() / 40.0;
  const double yaw = rpy_from_quaternion(imu(world).back().orientation).z();
  EXPECT_NEAR(turned, yaw, 1e-9);
}

TEST(Imu, services_set_and_take_away_biases) {
  TestWorld world(free_space(-kG));
  Entity& robot =
      world.spawn(still(hector("<accelDriftFrequency>0</accelDriftFrequency><rateDriftFrequency>0"
                               "</rateDriftFrequency><rateOffset>0 0 0.5</rateOffset>")),
                  "ball");
  const auto set_bias = [&robot](const char* name, const Vector3d& bias) {
    std::get<std::function<void(const Vector3d&)>>(service(robot, name).act)(bias);
  };
  set_bias("/imu/set_accel_bias", {0.1, 0.2, 0.3});
  set_bias("/imu/set_rate_bias", {0.01, 0.02, 0.03});
  world.run(0.01);
  ImuReading reading = imu(world).back();
  expect_near(reading.linear_acceleration, {0.1, 0.2, kG + 0.3}, 1e-12);
  expect_near(reading.angular_velocity, {0.01, 0.02, 0.53}, 1e-12);
  // The biased accelerometer levels it: tilted by bias / g about the other axis.
  const Vector3d tilt = rpy_from_quaternion(reading.orientation);
  EXPECT_NEAR(tilt.x(), 0.2 / kG, 1e-3);
  EXPECT_NEAR(tilt.y(), -0.1 / kG, 1e-3);
  const ImuReading bias = imu(world, "/imu/bias").back();
  expect_near(bias.linear_acceleration, {0.1, 0.2, 0.3}, 1e-12);
  expect_near(bias.angular_velocity, {0.01, 0.02, 0.53}, 1e-12);

  std::get<std::function<void()>>(service(robot, "/imu/calibrate").act)();
  world.run(0.01);
  expect_near(imu(world).back().angular_velocity, {0, 0, 0.5}, 1e-12);
  EXPECT_THROW(set_bias("/imu/set_rate_bias", {NAN, 0, 0}), Error);
}

TEST(Imu, yaw_bias_and_tuning) {
  TestWorld world(free_space(-kG));
  Entity& robot = world.spawn(still(hector("<yawOffset>0.2</yawOffset>")), "ball");
  world.run(0.01);
  EXPECT_NEAR(rpy_from_quaternion(imu(world).back().orientation).z(), 0.2, 1e-12);
  set(tuning(robot, "/imu/yaw"), "offset", -0.1);
  set(tuning(robot, "/imu/rate"), "offset", 0.7);
  set(tuning(robot, "/imu/accel"), "scale_error", 2.0);
  world.run(0.01);
  const ImuReading reading = imu(world).back();
  EXPECT_NEAR(rpy_from_quaternion(reading.orientation).z(), -0.1, 1e-12);
  expect_near(reading.angular_velocity, {0.7, 0.7, 0.7}, 1e-12);
  expect_near(reading.linear_acceleration, {0, 0, 2 * kG}, 1e-12);
}

TEST(Imu, covariances_are_those_of_the_noise) {
  TestWorld world(free_space(-kG));
  world.spawn(still(hector("<accelGaussianNoise>0.1 0.2 0.3</accelGaussianNoise>"
                           "<rateGaussianNoise>0.4</rateGaussianNoise>"
                           "<yawGaussianNoise>0.5</yawGaussianNoise>")),
              "ball");
  world.spawn(still(hector("<topicName>old</topicName><gaussianNoise>0.6</gaussianNoise>"
                           "<accelGaussianNoise>0.1</accelGaussianNoise>")),
              "other");
  world.run(0.01);
  const ImuReading reading = imu(world).back();
  EXPECT_NEAR(reading.linear_acceleration_covariance[2], 0.09, 1e-12);
  EXPECT_NEAR(reading.angular_velocity_covariance[0], 0.16, 1e-12);
  EXPECT_NEAR(reading.orientation_covariance[1], 0.04 / (kG * kG), 1e-12);
  EXPECT_NEAR(reading.orientation_covariance[2], 0.25, 1e-12);
  EXPECT_NEAR(imu(world, "/old").back().linear_acceleration_covariance[0], 0.36, 1e-12);
}

TEST(Imu, stock_model_plugin_has_no_gravity_unless_asked) {
  const auto stock = [](const char* keys) {
    return plugin("gazebo_ros_imu", std::string("<bodyName>nose</bodyName>") + keys);
  };
  TestWorld world(free_space(-kG));
  world.spawn(still(stock("<topicName>imu</topicName>")), "ball");
  world.spawn(still(stock("<topicName>with</topicName><gravity>true</gravity>"
                          "<serviceName>s</serviceName>")),
              "other");
  world.run(0.01);
  expect_near(imu(world).back().linear_acceleration, Vector3d::Zero(), 1e-12);
  expect_near(imu(world, "/with").back().linear_acceleration, {0, kG, 0}, 1e-12);
  // The nose is rolled by a quarter turn.
  EXPECT_NEAR(rpy_from_quaternion(imu(world).back().orientation).x(), kRightAngle, 1e-9);
}

TEST(Imu, bad_values_leave_the_unit_out_and_say_where) {
  const std::string bad[] = {
      hector("<bodyName>wing</bodyName>"),
      hector("<updateRate>often</updateRate>"),
      hector("<accelGaussianNoise>-1</accelGaussianNoise>"),
      hector("<rateDrift>much</rateDrift>"),
      hector("<vibrationStdAccel>1 -1 0</vibrationStdAccel>"),
      hector("<vibrationStdAccel>1 1 1</vibrationStdAccel><vibrationBand>9 3</vibrationBand>"),
      plugin("gazebo_ros_imu", ""),
      plugin("gazebo_ros_p3d", "<bodyName>body</bodyName>"),
      plugin("gazebo_ros_p3d",
             "<bodyName>body</bodyName><topicName>t</topicName><frameName>wing</frameName>"),
      plugin("hector_gazebo_ros_magnetic", "<inclination>100</inclination>"),
  };
  for (const std::string& each : bad) {
    TestWorld world(free_space(-kG));
    EXPECT_TRUE(world.spawn(ball(each), "ball").devices.empty()) << each;
    ASSERT_EQ(world.messages().size(), 1u) << each;
    EXPECT_NE(world.messages()[0].find("ball.urdf:1"), std::string::npos) << world.messages()[0];
  }
}

}  // namespace
}  // namespace ardee
