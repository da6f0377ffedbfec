// SPDX-License-Identifier: MIT
// Tests of the contract of a valid state (core/limits.h): input that would break it is refused and
// changes nothing; a body that leaves it in a step is put back, and the rest of the world
// continues.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "all_devices.h"
#include "ardee_sim/core/limits.h"
#include "reading_bytes.h"

namespace ardee {
using namespace physics;
using namespace devices;
namespace {

using Eigen::Vector3d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool is_said(const TestWorld& world, const std::string& part) {
  return std::any_of(
      world.messages().begin(), world.messages().end(),
      [&part](const std::string& text) { return text.find(part) != std::string::npos; });
}

constexpr const char* kLight =
    "<sdf version='1.6'><model name='m'><link name='l'><inertial><mass>1"
    "</mass><inertia><ixx>0.004</ixx><iyy>0.004</iyy><izz>0.004</izz>"
    "</inertia></inertial></link></model></sdf>";

Wrench wrench_on(Entity& entity, const Vector3d& force_W, const Vector3d& torque_W) {
  Wrench wrench;
  wrench.robot = entity.robot.get();
  wrench.force_W = force_W;
  wrench.torque_W = torque_W;
  wrench.duration_ns = 10000000;
  return wrench;
}

/// Returns all numbers of a model's motion in the physics.
std::vector<double> motion_of(const Entity& entity) {
  std::vector<double> numbers;
  const auto add = [&numbers](const auto& vector) {
    numbers.insert(numbers.end(), vector.data(), vector.data() + vector.size());
  };
  const Robot& robot = *entity.robot;
  for (std::size_t link = 0; link < robot.model().links.size(); ++link) {
    add(robot.link_pose(link).p);
    add(robot.link_pose(link).q.coeffs());
    add(robot.link_twist(link).linear);
    add(robot.link_twist(link).angular);
  }
  for (std::size_t joint = 0; joint < robot.model().joints.size(); ++joint) {
    if (robot.is_dynamic()) numbers.push_back(robot.dynamics().joint_position(joint));
  }
  return numbers;
}

TEST(ValidState, IsOneNormForAll) {
  EXPECT_TRUE(limits::is_valid(Pose{{1e6, 0, 0}, Eigen::Quaterniond::Identity()}));
  EXPECT_FALSE(limits::is_valid(Pose{{8e5, 8e5, 0}, Eigen::Quaterniond::Identity()}));
  EXPECT_FALSE(limits::is_valid(Pose{{kNan, 0, 0}, Eigen::Quaterniond::Identity()}));
  EXPECT_FALSE(limits::is_valid(Pose{{0, 0, 0}, Eigen::Quaterniond(kNan, 0, 0, 0)}));
  EXPECT_TRUE(limits::is_valid(Twist{{0, -1e9, 0}, {1e9, 0, 0}}));
  EXPECT_FALSE(limits::is_valid(Twist{{0, 0, 0}, {8e8, 8e8, 0}}));
  EXPECT_FALSE(limits::is_valid(Twist{{HUGE_VAL, 0, 0}, {0, 0, 0}}));
}

TEST(ValidState, IsRestoredToWhatLeavesItAndTheRestGoesOn) {
  TestWorld world("", 0.001);
  Entity& spun = world.spawn(kLight, "spun", at(1, 2, 3));
  Entity& thrown = world.spawn(kLight, "thrown", at(999990, 5, 6));
  world.spawn(kLight, "kept", at(0, 0, 100));
  world->wrenches().add(wrench_on(spun, {0, 0, 0}, {0, 0, 1e9}));
  world->wrenches().add(wrench_on(thrown, {1e9, 0, 0}, {0, 0, 0}));
  world.run(0.02);
  EXPECT_TRUE(is_said(world, "model 'spun' is put back"));
  EXPECT_TRUE(is_said(world, "model 'thrown' is put back"));
  EXPECT_FALSE(is_said(world, "model 'kept' is put back"));
  world.run(0.08);
  EXPECT_EQ(world->step_count(), 100u);
  EXPECT_NEAR(world->state("kept", "").twist.linear.z(), -0.98, 1e-9);
  EXPECT_LT((world->state("spun", "").pose.p - Vector3d(1, 2, 3)).norm(), 0.1);
  EXPECT_LT(world->state("spun", "").twist.angular.norm(), 1e-9);
  EXPECT_LT((world->state("thrown", "").pose.p - Vector3d(999990, 5, 6)).norm(), 0.1);
}

TEST(ValidState, IsSaidToBeRestoredOnceASecondHoweverOftenItIs) {
  TestWorld world("", 0.001);
  Entity& spun = world.spawn(kLight, "spun", at(1, 2, 3));
  for (int i = 0; i < 1500; ++i) {
    Wrench wrench = wrench_on(spun, {0, 0, 0}, {0, 0, 1e9});
    wrench.start_ns = world->now_ns();
    world->wrenches().add(wrench);
    world->step();
  }
  const auto said = [](const std::string& message) {
    return message.find("model 'spun' is put back") != std::string::npos;
  };
  EXPECT_EQ(std::count_if(world.messages().begin(), world.messages().end(), said), 2);
}

TEST(ValidState, OfAModelWhoseControllerAsksTooMuch) {
  TestWorld world("", 0.001);
  const std::string drive =
      model_device("gazebo_ros_diff_drive",
                   "<leftJoint>fl_joint</leftJoint><rightJoint>fr_joint</rightJoint>"
                   "<wheelDiameter>1e-6</wheelDiameter>");
  Entity& robot = world.spawn(rover_with({drive}), "rover", at(0, 0, 5));
  world.spawn(ball(""), "kept", at(9, 0, 100));
  world.command(robot, 1e5, 0.0);  // 2e11 rad/s
  world.run(0.1);
  EXPECT_TRUE(is_said(world, "model 'rover' is put back"));
  EXPECT_EQ(world->step_count(), 100u);
  EXPECT_NEAR(world->state("kept", "").twist.linear.z(), -0.98, 1e-9);
}

TEST(ValidState, ThatIsRefusedChangesNothing) {
  TestWorld world(free_space(0.0));
  Entity& robot = world.spawn(rover_with({}), "rover", at(0, 0, 5));
  world->set_state("rover", {at(1), {{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}}}, "");
  robot.robot->dynamics().set_joint_position(0, 0.7);
  const std::vector<double> before = motion_of(robot);
  const RelativeState refused[] = {
      {at(5), {{2e9, 0, 0}, {0, 0, 0}}},
      {at(5), {{0, 0, 0}, {0, 0, 2e9}}},
      {at(2e6), {}},
      {at(8e5, 8e5), {}},
      {at(kNan), {}},
      {at(5), {{0, kNan, 0}, {0, 0, 0}}},
      {at(-1e6), {}},  // its own frame would be within, but not its rear wheels
      {at(5), {{1e9, 0, 0}, {0, 0, 1e8}}},
  };
  for (const RelativeState& state : refused) {
    EXPECT_THROW(world->set_state("rover", state, ""), Error) << state.pose.p.transpose();
    EXPECT_EQ(motion_of(robot), before) << state.pose.p.transpose();
  }
  EXPECT_THROW(robot.robot->dynamics().set_joint_position(0, kNan), Error);
  EXPECT_EQ(motion_of(robot), before);
}

TEST(ValidState, OfASliderIsWithinTheWorld) {
  TestWorld world(free_space(0.0));
  const std::string inertial =
      "<inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1"
      "</izz></inertia></inertial>";
  const std::string slider =
      "<sdf version='1.6'><model name='m'><link name='a'>" + inertial + "</link><link name='b'>" +
      inertial +
      "</link><joint name='j' type='prismatic'><parent>a</parent><child>b</child><axis>"
      "<xyz>1 0 0</xyz></axis></joint></model></sdf>";
  Entity& entity = world.spawn(slider, "slider");
  PhysicsModel& dynamics = entity.robot->dynamics();
  dynamics.set_joint_position(0, 3.0);
  const std::vector<double> before = motion_of(entity);
  EXPECT_THROW(dynamics.set_joint_position(0, 2e6), Error);
  EXPECT_EQ(motion_of(entity), before);
  dynamics.set_joint_position(0, 9e5);
  EXPECT_NEAR(world->state("slider::b", "").pose.p.x(), 9e5, 1e-3);
}

TEST(ValidState, OfSceneryIsThatOfAllItHolds) {
  const std::string wide =
      "<model name='field'><static>1</static><link name='l'><pose>9e5 0 0 0 0 "
      "0</pose></link></model>";
  TestWorld world(wide);
  EXPECT_THROW(world->set_state("field", {at(2e6), {}}, ""), Error);
  EXPECT_EQ(world->state("field", "").pose.p, Vector3d::Zero());
}

/// gazebo_ros sets the given velocity in the frame's axes, without adding the frame's own velocity.
TEST(ValidState, VelocityIsTheOneAskedForInTheAxesOfAnyFrame) {
  TestWorld world(free_space(0.0));
  world.spawn(ball(""), "sled", Pose::from_xyz_rpy({0, 0, 1}, {0, 0, 1.0}));
  world.spawn(ball(""), "other", Pose::from_xyz_rpy({3, 0, 1}, {0, 0, -0.5}));
  world->set_state("other", {at(3), {{1, 2, 3}, {0.1, 0.2, 0.3}}}, "");
  const RelativeState wanted{Pose{}, {{0.4, 0, 0}, {0, 0, 0.1}}};
  for (const char* frame : {"sled", "sled::body", "sled", "other", "sled::nose", "sled"}) {
    const Eigen::Quaterniond q_WF = world->state(frame, "").pose.q;
    const RelativeState here{world->state("sled", frame).pose, wanted.twist};
    world->set_state("sled", here, frame);
    const Twist got = world->state("sled", "").twist;
    expect_near(got.linear, q_WF * wanted.twist.linear, 1e-12);
    expect_near(got.angular, q_WF * wanted.twist.angular, 1e-12);
    world->step();
  }
}

TEST(ValidState, CommandsThatAreNotFiniteAreRefusedAndChangeNothing) {
  const auto run = [](bool absurd) {
    TestWorld world(ground_plane(), 0.005);
    Entity& robot = world.spawn(rover_with(all_devices()), "rover", at(0, 0, 0.151));
    BytesByTopic bytes;
    world->set_sink(&bytes);
    command_all(robot);
    world.run(0.1);
    for (const auto& device : robot.devices) {
      if (!absurd) break;
      for (const double number : {kNan, HUGE_VAL, -HUGE_VAL}) {
        for (const Input& input : device->ports().all<Input>()) {
          if (input.kind == command_kind<Twist>()) {
            EXPECT_THROW(input.on_command(Twist{{number, 0, 0}, {0, 0, 0}}), Error) << input.topic;
            EXPECT_THROW(input.on_command(Twist{{0.9, 0, 0}, {0, 0, number}}), Error)
                << input.topic;
          }
          if (input.kind == command_kind<ForceTorque>()) {
            EXPECT_THROW(input.on_command(ForceTorque{{number, 0, 0}, {0, 0, 0}}), Error);
            EXPECT_THROW(input.on_command(ForceTorque{{0, 0, 0}, {0, number, 0}}), Error);
          }
          if (input.kind == command_kind<double>()) {
            EXPECT_THROW(input.on_command(number), Error) << input.topic;
          }
        }
      }
    }
    world.run(0.2);
    return bytes.take();
  };
  EXPECT_EQ(differing(run(false), run(true)), std::vector<std::string>{});
}

TEST(Spawn, CountsAModelsOwnPoseFromWhereItIsPut) {
  TestWorld world(free_space(0.0));
  const std::string text =
      "<sdf version='1.6'><model name='m'>%STATIC%<pose>1 0 0.5 0 0 0.3</pose>"
      "<link name='l'><inertial><mass>1</mass></inertial></link></model></sdf>";
  for (const char* also : {"", "<static>1</static>"}) {
    std::string xml = text;
    xml.replace(xml.find("%STATIC%"), 8, also);
    const std::string name = std::string("model") + (*also ? " that stands" : "");
    world.spawn(xml, name, Pose::from_xyz_rpy({0, 2, 0}, {0, 0, M_PI / 2}));
    const Pose pose = world->state(name, "").pose;
    expect_near(pose.p, {0, 3, 0.5}, 1e-12);
    EXPECT_NEAR(rpy_from_quaternion(pose.q).z(), M_PI / 2 + 0.3, 1e-12);
    world->reset_world();
    expect_near(world->state(name, "").pose.p, {0, 3, 0.5}, 1e-12);
  }
}

}  // namespace
}  // namespace ardee
