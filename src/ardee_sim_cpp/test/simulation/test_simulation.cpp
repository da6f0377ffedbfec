// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "ardee_sim/core/rng.h"
#include "fixture.h"

namespace ardee {
using namespace devices;
namespace {

const char* const kBall =
    "<sdf version='1.6'><model name='ball'><link name='link'><inertial><mass>1</mass><inertia>"
    "<ixx>0.004</ixx><iyy>0.004</iyy><izz>0.004</izz></inertia></inertial><collision "
    "name='c'><geometry>"
    "<sphere><radius>0.1</radius></sphere></geometry></collision></link>%PLUGIN%</model></sdf>";

std::string ball(const std::string& plugin = "") {
  std::string xml = kBall;
  return xml.replace(xml.find("%PLUGIN%"), 8, plugin);
}

const Pose kHigh = Pose::from_xyz_rpy({0, 0, 100}, {0, 0, 0});

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

bool any_contains(const std::vector<std::string>& texts, const std::string& part) {
  return std::any_of(texts.begin(), texts.end(),
                     [&](const std::string& text) { return text.find(part) != std::string::npos; });
}

TEST(Simulation, TimeIsCountedInWholeSteps) {
  TestWorld world("", 0.005);
  world.run(10.0);
  EXPECT_EQ(world->now_ns(), 10000000000);
  EXPECT_EQ(world->step_count(), 2000u);
}

TEST(Simulation, ASpawnedModelFallsAndARemovedOneIsGone) {
  TestWorld world("");
  world.spawn(ball(), "ball", kHigh);
  world.run(1.0);
  EXPECT_NEAR(world->state("ball", "").pose.p.z(), 100 - 0.5 * 9.8, 0.006);
  EXPECT_NEAR(world->state("ball", "").twist.linear.z(), -9.8, 1e-9);
  world->remove("ball");
  EXPECT_EQ(world->find("ball"), nullptr);
  EXPECT_TRUE(world->entities().empty());
  world.run(0.1);
  EXPECT_EQ(refusal([&] { world->remove("ball"); }), "model 'ball' does not exist");
}

TEST(Simulation, ANameIsTakenOnce) {
  TestWorld world("");
  world.spawn(ball(), "ball", kHigh);
  EXPECT_EQ(refusal([&] { world.spawn(ball(), "ball"); }), "entity already exists: 'ball'");
  EXPECT_EQ(refusal([&] { world.spawn(ball(), "world"); }),
            "found the model name 'world', which is that of the inertial frame, expected another");
}

TEST(Simulation, AnUnknownPluginIsAWarning) {
  TestWorld world("");
  world.spawn(ball("<plugin name='p' filename='libgazebo_ros_lazer.so'/>"), "ball", kHigh);
  EXPECT_TRUE(any_contains(
      world.messages(),
      "found plugin 'libgazebo_ros_lazer.so', expected one in docs/support.md; nearest: "
      "libgazebo_ros_laser.so, "));
  EXPECT_TRUE(any_contains(world.messages(), " in all); it is left out"));
  EXPECT_NE(world->find("ball"), nullptr);
}

TEST(Simulation, WithoutALogSinkWarningsGoToStandardError) {
  World world;
  world.plugins.push_back({"moon", "libmoon.so", {}});
  testing::internal::CaptureStderr();
  const Simulation simulation(std::move(world), {}, nullptr);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("world plugin 'libmoon.so'"),
            std::string::npos);
}

TEST(Simulation, ABadPluginValueRefusesTheSpawnAndLeavesNothing) {
  TestWorld world("");
  const std::string plugin =
      "<plugin name='p' filename='libgazebo_ros_diff_drive.so'>"
      "<leftJoint>no_such</leftJoint><rightJoint>nor_this</rightJoint></plugin>";
  const std::string message = refusal([&] { world.spawn(ball(plugin), "ball", kHigh); });
  EXPECT_NE(message.find("found joint 'no_such'"), std::string::npos) << message;
  EXPECT_NE(message.find("ball.urdf:1"), std::string::npos) << message;
  EXPECT_EQ(world->find("ball"), nullptr);
  world.run(0.1);
  world.spawn(ball(), "ball", kHigh);
}

TEST(Simulation, ABadValueOfAPluginThatPublishesLeavesThePluginOut) {
  TestWorld world("");
  const std::string plugin =
      "<plugin name='p' filename='libgazebo_ros_joint_state_publisher.so'>"
      "<jointName>no_such</jointName></plugin>";
  const Entity& robot = world.spawn(ball(plugin), "ball", kHigh);
  EXPECT_TRUE(robot.devices.empty());
  EXPECT_TRUE(any_contains(world.messages(), "is left out: ball.urdf:1: <plugin>: found joint"));
}

/// Two good models, and between them one with a plane that moves, and one with a drive without its
/// joints.
const std::string kTwoBadModels =
    static_box("a", "0 0 0 0 0 0", "1 1 1") +
    "<model name='m'><link name='l'><collision name='c'><geometry><plane/></geometry></collision>"
    "</link></model><model name='n'><link name='l'/><plugin name='d' "
    "filename='libgazebo_ros_diff_drive.so'><leftJoint>nope</leftJoint><rightJoint>no</rightJoint>"
    "</plugin></model>" +
    static_box("z", "5 0 0 0 0 0", "1 1 1");

TEST(Simulation, LeavesOutModelsOfTheWorldThatCannotBeBuilt) {
  SimulationOptions options;
  options.bad_parts = BadParts::kLeaveOut;
  TestWorld world(kTwoBadModels, 0.001, options);
  ASSERT_EQ(world->entities().size(), 2u);
  EXPECT_EQ(world->entities()[1]->name(), "z");
  EXPECT_TRUE(any_contains(world.messages(), "; model 'm' is left out"));
  EXPECT_TRUE(
      any_contains(world.messages(),
                   "found joint 'nope', expected one of: none, as the model has none; model "
                   "'n' is left out"));
  EXPECT_EQ(world.messages().size(), 2u);
  world.run(0.1);
  world.spawn(ball(), "m", kHigh);
}

TEST(Simulation, RefusesAWorldWithAModelThatCannotBeBuilt) {
  EXPECT_THROW(TestWorld{kTwoBadModels}, Error);
}

TEST(Simulation, ResetWorldPutsModelsBackAndLeavesTheClock) {
  TestWorld world("");
  world.spawn(ball(), "ball", kHigh);
  world.run(1.0);
  world->reset_world();
  EXPECT_EQ(world->now_ns(), 1000000000);
  EXPECT_EQ(world->state("ball", "").pose.p, kHigh.p);
  EXPECT_EQ(world->state("ball", "").twist.linear.norm(), 0.0);
}

TEST(Simulation, ResetSimulationRepeatsTheSameBytes) {
  TestWorld world(room() + ground_plane(), 0.005);
  world.spawn(ball(), "ball", Pose::from_xyz_rpy({1, 0, 2}, {0.1, 0.2, 0.3}));
  world.spawn(lidar_post("libgazebo_ros_laser.so", "ray", 101, 0.02), "post",
              Pose::from_xyz_rpy({0, 0, 0.1}, {0, 0, 0}));
  const auto record = [&] {
    world.recorder().clear();
    world.run(2.0);
    std::vector<float> all;
    for (const LidarReading& scan : world.recorder().on<LidarReading>("/scan")) {
      all.insert(all.end(), scan.ranges_m.begin(), scan.ranges_m.end());
    }
    return all;
  };
  const std::vector<float> first = record();
  world->reset_simulation();
  EXPECT_EQ(world->now_ns(), 0);
  const std::vector<float> second = record();
  ASSERT_EQ(first.size(), 80u * 101u);
  EXPECT_EQ(0, std::memcmp(first.data(), second.data(), first.size() * sizeof(float)));
}

TEST(Simulation, StatesAreRelativeToModelsAndLinks) {
  TestWorld world("");
  world.spawn(ball(), "a", Pose::from_xyz_rpy({1, 2, 3}, {0, 0, M_PI / 2}));
  world.spawn(ball(), "b", Pose::from_xyz_rpy({1, 4, 3}, {0, 0, 0}));
  const RelativeState seen = world->state("b", "a::link");
  EXPECT_TRUE(seen.pose.p.isApprox(Eigen::Vector3d(2, 0, 0)));
  EXPECT_NEAR(rpy_from_quaternion(seen.pose.q).z(), -M_PI / 2, 1e-9);
  EXPECT_NE(refusal([&] { world->state("b", "c"); }), "");
}

TEST(Simulation, AModelMovesWithItsRootLinkWhateverLinkComesFirst) {
  const std::string inertial =
      "<inertial><mass value='1'/><inertia ixx='0.1' iyy='0.1' izz='0.1' ixy='0' ixz='0' "
      "iyz='0'/></inertial>";
  TestWorld world("<gravity>0 0 0</gravity>");
  const Entity& robot = world.spawn(
      "<robot name='r'><link name='wheel'>" + inertial + "</link><link name='base'>" + inertial +
          "</link><joint name='j' type='continuous'><parent link='base'/><child link='wheel'/>"
          "<origin xyz='0.3 0 0.2'/><axis xyz='0 1 0'/></joint></robot>",
      "r", kHigh);
  robot.robot->dynamics().apply_joint_effort(0, 0.5);
  world->step();
  // Wheel and base turn about one axis in opposite directions; the wheel's own rate is not the
  // model's.
  const Twist base = world->state("r::base", "").twist;
  const Twist model = world->state("r", "").twist;
  EXPECT_LT(base.angular.y(), -1e-4);
  EXPECT_GT(world->state("r::wheel", "").twist.angular.y(), 1e-4);
  EXPECT_LT((model.angular - base.angular).norm(), 1e-12);
  EXPECT_LT((model.linear - base.linear).norm(), 1e-12);
}

TEST(Simulation, AStaticModelStaysWithinTheWorldToo) {
  TestWorld world("");
  std::string xml = ball();
  xml.replace(xml.find("<link"), 5, "<static>1</static><link");
  const Pose far = Pose::from_xyz_rpy({0, 1e300, 0}, {0, 0, 0});
  EXPECT_NE(refusal([&] { world.spawn(xml, "stone", far); }).find("farther than 1000000 m"),
            std::string::npos);
  EXPECT_EQ(world->find("stone"), nullptr);
  world.spawn(xml, "stone", kHigh);
  EXPECT_NE(refusal([&] {
              world->set_state("stone", {far, {}}, "");
            }).find("farther than"),
            std::string::npos);
  EXPECT_EQ(world->state("stone", "").pose.p.z(), 100.0);
}

TEST(Simulation, AModelWithALinkBeyondTheWorldIsRefused) {
  TestWorld world("");
  world.spawn(ball(), "kept", kHigh);
  for (const char* also : {"", "<static>1</static>"}) {
    const std::string far = std::string("<sdf version='1.6'><model name='m'>") + also +
                            "<link name='l'><pose>1e8 0 0 0 0 0</pose></link></model></sdf>";
    EXPECT_NE(refusal([&] { world.spawn(far, "far"); }).find("'far::l': found a pose"),
              std::string::npos);
    EXPECT_EQ(world->find("far"), nullptr);
  }
  world.run(1.0);
  EXPECT_NEAR(world->state("kept", "").twist.linear.z(), -9.8, 1e-9) << "the world goes on";
}

TEST(Simulation, AFixedLinkMayLackMassOrInertia) {
  const std::string zero = "<inertia ixx='0' ixy='0' ixz='0' iyy='0' iyz='0' izz='0'/></inertial>";
  const auto robot = [&zero](const std::string& mass, const std::string& joint) {
    return "<robot name='r'><link name='base'><inertial><mass value='2'/>"
           "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>"
           "<link name='tip'><inertial><mass value='" +
           mass + "'/>" + zero + "</link><joint name='j' type='" + joint +
           "'><parent link='base'/><child link='tip'/><origin xyz='1.5 0 0'/>"
           "<axis xyz='0 0 1'/></joint></robot>";
  };
  TestWorld world("<gravity>0 0 0</gravity>", 0.001);
  world.spawn(robot("0", "fixed"), "0", kHigh);
  EXPECT_TRUE(any_contains(world.messages(), "it moves with the link that it is fixed to"));
  world.spawn(robot("0", "continuous"), "held", kHigh);
  EXPECT_TRUE(any_contains(world.messages(), "found no mass on a link that moves"));
  world.spawn(robot("1", "fixed"), "1", kHigh);
  EXPECT_TRUE(any_contains(world.messages(), "it counts as a part of the body"));
  // The masses are 2 and 1 kg at 1.5 m: the moment about their centre is 1 + 2 / 3 * 1.5^2.
  Wrench turn;
  turn.robot = world->find("1")->robot.get();
  turn.torque_W = {0, 0, 1};
  turn.duration_ns = 1000000;
  world->wrenches().add(turn);
  world->step();
  EXPECT_NEAR(world->state("1", "").twist.angular.z(), 0.001 / 2.5, 1e-9);
}

TEST(Simulation, NamesMayHoldColonsAndALinkIsFoundByItsNameAlone) {
  TestWorld world("<gravity>0 0 0</gravity>");
  world.spawn(ball(), "field::ball", kHigh);
  EXPECT_EQ(world->state("field::ball", "").pose.p.z(), 100.0);
  EXPECT_EQ(world->state("field::ball::link", "").pose.p.z(), 100.0);
  EXPECT_EQ(world->state("link", "").pose.p.z(), 100.0);
  world.spawn(ball(), "other");
  EXPECT_EQ(world->find_link("other::link")->entity->name(), "other");
  EXPECT_EQ(world->find_link("link")->entity->name(), "field::ball") << "the first that came";
  EXPECT_FALSE(world->find_link("other::wheel"));
  EXPECT_NE(refusal([&] { world->state("field", ""); }).find("'field' does not exist"),
            std::string::npos);
}

TEST(Simulation, SetStateMovesRelativeToAnotherModel) {
  TestWorld world("");
  world.spawn(ball(), "a", Pose::from_xyz_rpy({1, 2, 3}, {0, 0, M_PI / 2}));
  world.spawn(ball(), "b", kHigh);
  RelativeState state;
  state.pose.p = {1, 0, 0};
  state.twist.linear = {0.5, 0, 0};
  world->set_state("b", state, "a");
  EXPECT_TRUE(world->state("b", "").pose.p.isApprox(Eigen::Vector3d(1, 3, 3)));
  EXPECT_TRUE(world->state("b", "").twist.linear.isApprox(Eigen::Vector3d(0, 0.5, 0)));
}

TEST(Simulation, MovingSceneryMovesWhatRaysMeetAndAResetPutsItBack) {
  TestWorld world(static_box("box", "3 0 0 0 0 0", "1 1 1"));
  world.spawn(lidar_post("libgazebo_ros_laser.so", "ray", 3), "post");
  const auto ahead = [&] {
    world.recorder().clear();
    world.run(0.025);
    return world.recorder().on<LidarReading>("/scan").back().ranges_m[1];
  };
  EXPECT_NEAR(ahead(), 2.5, 1e-5);
  RelativeState state;
  state.pose.p = {5, 0, 0};
  world->set_state("box", state, "world");
  EXPECT_NEAR(ahead(), 4.5, 1e-5);
  world->reset_world();
  EXPECT_NEAR(ahead(), 2.5, 1e-5);
  world->remove("box");
  EXPECT_TRUE(std::isinf(ahead()));
}

TEST(Simulation, WrenchesAddUpAndEnd) {
  TestWorld world("");
  Entity& ball_entity = world.spawn(ball(), "ball", kHigh);
  Wrench push;
  push.robot = ball_entity.robot.get();
  push.force_W = {1, 0, 0};
  push.duration_ns = 1000000000;
  world->wrenches().add(push);
  push.force_W = {2, 0, 9.8};  // carries the weight, too
  world->wrenches().add(push);
  world.run(2.0);
  // The force m a acts for one second: 3 m/s.
  EXPECT_NEAR(world->state("ball", "").twist.linear.x(), 3.0, 1e-9);
  EXPECT_NEAR(world->state("ball", "").twist.linear.z(), -9.8, 1e-9);
}

TEST(Simulation, AWrenchBeyondAnyUseIsRefused) {
  TestWorld world("");
  Entity& ball_entity = world.spawn(ball(), "ball", kHigh);
  Wrench push;
  push.robot = ball_entity.robot.get();
  push.duration_ns = -1;
  for (const double newtons : {1e300, std::nan(""), -HUGE_VAL}) {
    push.force_W = {newtons, 0, 0};
    EXPECT_NE(refusal([&] { world->wrenches().add(push); }), "");
  }
  push.force_W = {1, 0, 0};
  push.point_L = {0, 0, 1e9};
  EXPECT_NE(refusal([&] { world->wrenches().add(push); }), "");
  world.run(0.1);
  EXPECT_NEAR(world->state("ball", "").twist.linear.x(), 0.0, 1e-12);
}

TEST(Simulation, AModelThatDivergesIsPutBackAndTheRestGoesOn) {
  TestWorld world("");
  Entity& lost = world.spawn(ball(), "lost", kHigh);
  world.spawn(ball(), "kept", Pose::from_xyz_rpy({5, 0, 100}, {0, 0, 0}));
  Wrench push;
  push.robot = lost.robot.get();
  push.force_W = {1e9, 0, 0};
  push.duration_ns = 2000000;
  world->wrenches().add(push);
  world.run(1.0);  // at 2,000 km/s it leaves the world
  EXPECT_TRUE(world->state("lost", "").pose.is_finite());
  EXPECT_TRUE(any_contains(world.messages(), "model 'lost' is put back"));
  EXPECT_NEAR(world->state("kept", "").twist.linear.z(), -9.8, 1e-9);
}

TEST(Simulation, TheWorldHasTheNamesThatGazeboRosGivesIt) {
  TestWorld world("");
  world.spawn(ball(), "ball", kHigh);
  for (const char* name : {"", "world", "map", "/map"}) {
    EXPECT_EQ(world->state("ball", name).pose.p, kHigh.p) << name;
  }
}

}  // namespace
}  // namespace ardee
