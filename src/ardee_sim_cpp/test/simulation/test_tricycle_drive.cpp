// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "fixture.h"

namespace ardee {
using namespace physics;
using namespace devices;
namespace {

constexpr double kRadius_m = 0.1;
constexpr double kWheelBase_m = 0.6;

std::string wheel(const std::string& name, const std::string& parent, const std::string& xyz) {
  return "<link name='" + name +
         "'><inertial><mass value='0.5'/><inertia ixx='2e-3' ixy='0' ixz='0' iyy='2.5e-3' iyz='0' "
         "izz='2e-3'/></inertial><collision><origin rpy='1.5707963267948966 0 0'/><geometry>"
         "<cylinder radius='0.1' length='0.02'/></geometry></collision></link><joint name='" +
         name + "_joint' type='continuous'><parent link='" + parent + "'/><child link='" + name +
         "'/><origin xyz='" + xyz + "'/><axis xyz='0 1 0'/></joint>";
}

/// Returns a tricycle with its origin on the ground between the rear wheels.
std::string tricycle(const std::string& keys) {
  return "<robot name='trike'><link name='base_link'><inertial><origin xyz='0.25 0 0.12'/>"
         "<mass value='8'/><inertia ixx='0.1' ixy='0' ixz='0' iyy='0.2' iyz='0' izz='0.2'/>"
         "</inertial></link><link name='fork'><inertial><mass value='0.3'/><inertia ixx='1e-3' "
         "ixy='0' ixz='0' iyy='1e-3' iyz='0' izz='1e-3'/></inertial></link>"
         "<joint name='front_steering_joint' type='revolute'><parent link='base_link'/>"
         "<child link='fork'/><origin xyz='0.6 0 0.1'/><axis xyz='0 0 1'/>"
         "<limit lower='-1.6' upper='1.6' effort='50' velocity='10'/></joint>" +
         wheel("front_wheel", "fork", "0 0 0") +
         wheel("left_rear_wheel", "base_link", "0 0.25 0.1") +
         wheel("right_rear_wheel", "base_link", "0 -0.25 0.1") +
         "<gazebo><plugin name='drive' filename='libgazebo_ros_tricycle_drive.so'>"
         "<actuatedWheelDiameter>0.2</actuatedWheelDiameter>"
         "<encoderWheelDiameter>0.2</encoderWheelDiameter><wheelTorque>20</wheelTorque>" +
         keys + "</plugin></gazebo></robot>";
}

/// Sends a command; linear.x: speed of the front wheel, angular.z: its angle.
void command(Entity& robot, double speed_m_per_s, double angle_rad) {
  robot.devices.at(0)->ports().all<Input>().at(0).get().on_command(
      Twist{{speed_m_per_s, 0, 0}, {0, 0, angle_rad}});
}

double joint_position(Entity& robot, const std::string& name) {
  return robot.robot->dynamics().joint_position(robot.robot->joint_index(name, Source{}));
}

TEST(TricycleDrive, GoesAroundTheCircleOfItsSteeringAngle) {
  TestWorld world(ground_plane());
  Entity& robot = world.spawn(tricycle("<odometrySource>encoder</odometrySource>"), "trike");
  const double angle = 0.5, speed = 0.4;
  command(robot, 0.0, angle);
  world.run(0.5);
  EXPECT_NEAR(joint_position(robot, "front_steering_joint"), angle, 1e-3);
  world->reset_world();
  command(robot, speed, angle);
  world.run(4.0);
  // The front wheel goes at `speed` along its angle: yaw rate v sin(a) / L, rear at v cos(a).
  const Twist twist = world->state("trike", "").twist;
  EXPECT_NEAR(twist.angular.z(), speed * std::sin(angle) / kWheelBase_m, 0.01);
  EXPECT_NEAR(twist.linear.norm(), speed * std::cos(angle), 0.01);
  const Pose truth = world->state("trike", "").pose;
  const auto odometry = world.recorder().on<OdometryReading>("/odom").back();
  EXPECT_EQ(odometry.child_frame_id, "base_link");
  EXPECT_LT((odometry.pose.p - truth.p).head<2>().norm(), 0.05);
  EXPECT_NEAR(odometry.twist.angular.z(), twist.angular.z(), 0.02);
  EXPECT_GT(rpy_from_quaternion(odometry.pose.q).z(), 0.5);
}

TEST(TricycleDrive, KeepsToSteeringSpeedAndAcceleration) {
  TestWorld world(ground_plane());
  Entity& robot = world.spawn(
      tricycle("<steeringSpeed>0.5</steeringSpeed><wheelAcceleration>0.2</wheelAcceleration>"),
      "trike");
  command(robot, 1.0, 3.0);  // beyond a quarter turn
  world.run(1.0);
  EXPECT_NEAR(joint_position(robot, "front_steering_joint"), 0.5, 0.02);
  PhysicsModel& dynamics = robot.robot->dynamics();
  const std::size_t front = robot.robot->joint_index("front_wheel_joint", Source{});
  EXPECT_NEAR(dynamics.joint_velocity(front) * kRadius_m, 0.2, 0.02);
  world.run(4.0);
  EXPECT_NEAR(joint_position(robot, "front_steering_joint"), M_PI / 2.0, 0.02);
}

}  // namespace
}  // namespace ardee
