// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "cameras.h"
#include "motion_rig.h"

namespace ardee {
using namespace devices;
namespace {

constexpr double kStep_s = 0.001;
constexpr double kFar_m = 5.0;  // distance of the mark

/// Returns a link's inertia, with the mass in its middle.
std::string inertial(const std::string& mass_kg, const std::string& moment) {
  return "<inertial><mass>" + mass_kg + "</mass><inertia><ixx>" + moment + "</ixx><iyy>" + moment +
         "</iyy><izz>" + moment + "</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>";
}

/// Returns a head on a joint about `axis`, held by the world at the origin; `in_head` goes into its
/// link.
std::string head(const std::string& axis, const std::string& plugins,
                 const std::string& in_head = "", const std::string& limits = "") {
  return "<sdf version='1.6'><model name='head'><link name='base'>" + inertial("5", "1") +
         "</link><joint name='foot' type='fixed'><parent>world</parent><child>base</child></joint>"
         "<link name='head'>" +
         inertial("0.4", "0.0005") + in_head +
         "</link><joint name='neck' type='revolute'><parent>base</parent><child>head</child><axis>"
         "<xyz>" +
         axis + "</xyz><limit><lower>-1.5</lower><upper>1.5</upper>" + limits +
         "</limit></axis></joint>" + plugins + "</model></sdf>";
}

std::string servo(const std::string& keys = "") {
  return plugin("ardee_ros_joint_position", "<joint>neck</joint>" + keys);
}

const Input& command(const Entity& robot) {
  for (const auto& device : robot.devices) {
    for (const Input& input : device->ports().all<Input>()) {
      if (input.kind == command_kind<double>() && input.topic.find("set_hfov") == std::string::npos)
        return input;
    }
  }
  throw std::runtime_error("no command");
}

double angle(const Entity& robot) {
  const std::size_t neck = robot.robot->joint_index("neck", {});
  return robot.robot->dynamics().joint_position(neck);
}

TEST(JointPosition, GoesThereAtItsSpeedAndAcceleration) {
  TestWorld world(free_space(0.0), kStep_s);
  Entity& robot = world.spawn(
      head("0 0 1", servo("<maxVelocity>2</maxVelocity><maxAcceleration>10</maxAcceleration>"
                          "<maxEffort>5</maxEffort>")),
      "head");
  ASSERT_EQ(command(robot).topic, "/neck_position_controller/command");
  command(robot).on_command(1.2);
  // The head takes 0.2 s up to speed over 0.2 m, 0.4 s at speed, 0.2 s down: 1.2 / 2 + 2 / 10 = 0.8
  // s.
  world.run(0.2);
  EXPECT_NEAR(angle(robot), 0.2, 0.01);
  world.run(0.2);
  EXPECT_NEAR(angle(robot), 0.6, 0.01);
  world.run(0.2);
  EXPECT_NEAR(angle(robot), 1.0, 0.01);
  world.run(0.21);
  EXPECT_NEAR(angle(robot), 1.2, 2e-3);
  world.run(0.5);
  EXPECT_NEAR(angle(robot), 1.2, 1e-6);
  // The way back is short, and the head never gets up to speed: 2 sqrt(0.1 / 10) = 0.2 s.
  command(robot).on_command(1.1);
  world.run(0.1);
  EXPECT_NEAR(angle(robot), 1.15, 0.005);
  world.run(0.11);
  EXPECT_NEAR(angle(robot), 1.1, 2e-3);
}

TEST(JointPosition, StopsAtTheJointsLimit) {
  TestWorld world(free_space(0.0), kStep_s);
  Entity& robot = world.spawn(head("0 0 1", servo("<maxVelocity>5</maxVelocity>")), "head");
  command(robot).on_command(-40.0);
  world.run(1.0);
  EXPECT_NEAR(angle(robot), -1.5, 1e-4);
  command(robot).on_command(0.0);
  world.run(1.0);
  EXPECT_NEAR(angle(robot), 0.0, 1e-4);
}

TEST(JointPosition, HoldsAgainstWhatItsEffortCan) {
  // The head's centre of mass is 0.1 m off the axis: 0.4 kg g 0.1 m = 0.392 N m when level.
  const std::string heavy = "<inertial><pose>0.1 0 0 0 0 0</pose>";
  const auto farthest_sag = [&](const std::string& effort) {
    std::string xml = head("0 1 0", servo("<maxEffort>" + effort + "</maxEffort>"));
    xml.replace(xml.rfind("<inertial>"), 10, heavy);
    TestWorld world(free_space(-9.8), kStep_s);
    Entity& robot = world.spawn(xml, "head");
    double farthest = 0.0;
    for (int i = 0; i < 1000; ++i) {
      world->step();
      farthest = std::max(farthest, std::abs(angle(robot)));
    }
    return farthest;
  };
  EXPECT_LT(farthest_sag("0.5"), 1e-3);
  // It falls until the weight's work equals the work against 0.3 N m: 0.392 sin(a) = 0.3 a.
  const double a = farthest_sag("0.3");
  EXPECT_NEAR(0.392 * std::sin(a), 0.3 * a, 0.01);
  EXPECT_GT(a, 1.0);
}

TEST(JointPosition, IsHeldWhereItIsAfterAReset) {
  TestWorld world(free_space(0.0), kStep_s);
  Entity& robot = world.spawn(head("0 0 1", servo("<maxVelocity>1</maxVelocity>")), "head");
  command(robot).on_command(1.0);
  world.run(0.3);
  world->reset_world();
  world.run(1.0);
  EXPECT_NEAR(angle(robot), 0.0, 1e-4);
}

/// Returns the place of the one white mark in the last picture [px].
Eigen::Vector2d mark_in(const ImageReading& image) {
  Eigen::Vector2d sum(0, 0);
  double count = 0.0;
  for (std::size_t row = 0; row < image.height; ++row) {
    for (std::size_t column = 0; column < image.width; ++column) {
      if (image.data[row * image.step + 3 * column] < 128) continue;
      sum += Eigen::Vector2d(static_cast<double>(column), static_cast<double>(row));
      count += 1.0;
    }
  }
  return sum / count;
}

/// Returns the place of a mark straight ahead in the picture of a camera on a head after a
/// commanded turn.
Eigen::Vector2d mark_after_turn(const std::string& axis, double turn_rad) {
  TestWorld world(
      "<scene><ambient>0 0 0 1</ambient><background>0 0 0 1</background></scene>" +
          free_space(0.0) +
          glowing_box("mark", std::to_string(kFar_m + 0.005) + " 0 0 0 0 0", "0.01 0.1 0.1", 1.0),
      kStep_s);
  const std::string camera =
      "<sensor name='eye' type='camera'><update_rate>10</update_rate>" +
      camera_block(320, 240, 1.2) +
      "<plugin name='eye' filename='libgazebo_ros_camera.so'><cameraName>cam</cameraName>"
      "<exposure>1</exposure></plugin></sensor>";
  Entity& robot = world.spawn(head(axis, servo("<maxVelocity>3</maxVelocity>"), camera), "head");
  command(robot).on_command(turn_rad);
  world.run(1.0);
  return mark_in(world.recorder().on<ImageReading>("/cam/image_raw").back());
}

TEST(JointPosition, APannedOrTiltedCameraSeesTheMarkMove) {
  const double f_px = 160.0 / std::tan(0.6);
  // After a pan to the left, a point ahead appears to the right; after a tilt down, above.
  for (const double turn : {0.3, -0.2}) {
    const Eigen::Vector2d panned = mark_after_turn("0 0 1", turn);
    EXPECT_NEAR(panned.x(), 159.5 + f_px * std::tan(turn), 0.6);
    EXPECT_NEAR(panned.y(), 119.5, 0.6);
    const Eigen::Vector2d tilted = mark_after_turn("0 1 0", turn);
    EXPECT_NEAR(tilted.x(), 159.5, 0.6);
    EXPECT_NEAR(tilted.y(), 119.5 - f_px * std::tan(turn), 0.6);
  }
}

TEST(JointPosition, BadKeysRefuseTheRobot) {
  TestWorld world(free_space(0.0));
  const auto complaint = [&](const std::string& keys) -> std::string {
    try {
      world.spawn(head("0 0 1", plugin("ardee_ros_joint_position", keys)), "head");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(complaint("<joint>nek</joint>").find("nek"), std::string::npos);
  EXPECT_NE(complaint("<joint>foot</joint>").find("expected a revolute"), std::string::npos);
  EXPECT_NE(complaint("<joint>neck</joint><maxVelocity>0</maxVelocity>").find("found 0"),
            std::string::npos);
  EXPECT_NE(complaint("").find("<joint>"), std::string::npos);
}

TEST(TorsionalSpring, WithItsJointAloneItHasTheDefaultsOfTheThesis) {
  TestWorld world(free_space(0.0), kStep_s);
  Entity& robot = world.spawn(
      head("0 1 0", plugin("TorsionalSpringPlugin", "<joint_handle>neck</joint_handle>")), "head");
  // Listing A.27: 100 N m/rad, 1 N m s/rad, reference 1 rad. Of 0.0005 kg m2 both roots of
  // I s2 + c s + k are real, -106 and -1894 per second: the way left after 0.01 s is
  // (1894 exp(-1.06) - 106 exp(-18.9)) / 1788.
  world.run(0.01);
  EXPECT_NEAR(angle(robot), 1.0 - 0.369, 0.02);
  world.run(0.5);
  EXPECT_NEAR(angle(robot), 1.0, 1e-6);
  EXPECT_THROW(world.spawn(head("0 1 0", plugin("TorsionalSpringPlugin", "")), "other"), Error);
}

TEST(TorsionalSpring, ItsReferenceCanBeMoved) {
  TestWorld world(free_space(0.0), kStep_s);
  Entity& robot = world.spawn(
      head("0 1 0", plugin("TorsionalSpringPlugin",
                           "<joint_handle>neck</joint_handle><spring_stiffness>0.2"
                           "</spring_stiffness><spring_damping>0.02</spring_damping>"
                           "<spring_reference>0</spring_reference><lower_limit>-1</lower_limit>"
                           "<upper_limit>1</upper_limit><referenceTopic>tilt</referenceTopic>")),
      "head");
  EXPECT_EQ(command(robot).topic, "/tilt");
  command(robot).on_command(0.6);
  world.run(2.0);
  EXPECT_NEAR(angle(robot), 0.6, 1e-3);
  command(robot).on_command(7.0);
  world.run(2.0);
  EXPECT_NEAR(angle(robot), 1.0, 1e-3);
  world->reset_world();
  world.run(2.0);
  EXPECT_NEAR(angle(robot), 0.0, 1e-3);
}

}  // namespace
}  // namespace ardee
