// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/joint_error.h"
#include "rig.h"

namespace ardee::control {
using namespace physics;
using namespace devices;
namespace {

JointHandle joint_at(JointType type, double position) {
  JointHandle joint;
  joint.type = type;
  joint.position = position;
  joint.limits.lower = -3.0;
  joint.limits.upper = 3.0;
  return joint;
}

TEST(PositionError, IsTheShortestTurnOfAContinuousJoint) {
  EXPECT_NEAR(position_error(joint_at(JointType::kContinuous, 3.0), -3.0), 2.0 * kPi - 6.0, 1e-12);
  EXPECT_NEAR(position_error(joint_at(JointType::kContinuous, 20.0 * kPi), 0.5), 0.5, 1e-12);
}

TEST(PositionError, StaysWithinTheLimitsOfARevoluteJoint) {
  EXPECT_NEAR(position_error(joint_at(JointType::kRevolute, 2.9), -2.9), -5.8, 1e-12);
  EXPECT_NEAR(position_error(joint_at(JointType::kRevolute, 1.0), 2.0), 1.0, 1e-12);
}

TEST(PositionError, IsTheDifferenceOfAPrismaticJoint) {
  EXPECT_EQ(position_error(joint_at(JointType::kPrismatic, 0.0), 7.0), 7.0);
}

class PidController : public testing::Test {
 protected:
  void add_joint(JointInterface interface, JointType type) {
    rig.add_joint("j", interface, type);
    rig.joint("j").limits.lower = -1.0;
    rig.joint("j").limits.upper = 1.0;
  }
  const JointControllerReading& state() { return rig.last<JointControllerReading>("/base/state"); }

  Rig rig;
  Parameters parameters{{"joint", std::string("j")}, {"pid/p", 10.0}, {"pid/d", 0.1}};
};

TEST_F(PidController, BringsAPositionWithinItsLimits) {
  add_joint(JointInterface::kEffort, JointType::kRevolute);
  rig.joint("j").position = 0.25;
  rig.start("effort_controllers/JointPositionController", parameters);
  rig.update();
  EXPECT_EQ(rig.command_of("j"), 0.0);  // it holds its place
  rig.send("/base/command", 5.0);
  rig.update();
  EXPECT_NEAR(rig.command_of("j"), 10.0 * 0.75 + 0.1 * 0.75 / 0.01, 1e-9);
  rig.update();
  EXPECT_NEAR(rig.command_of("j"), 10.0 * 0.75, 1e-9);
}

TEST_F(PidController, PublishesItsStateEachTenthUpdate) {
  add_joint(JointInterface::kEffort, JointType::kRevolute);
  parameters["pid/i"] = 3.0;
  parameters["pid/i_clamp"] = 2.0;
  parameters["pid/antiwindup"] = true;
  rig.start("effort_controllers/JointPositionController", parameters);
  rig.joint("j").position = 0.5;
  rig.joint("j").velocity = 0.1;
  rig.send("/base/command", 5.0);
  rig.update();
  ASSERT_EQ(rig.count("/base/state"), 1u);
  EXPECT_EQ(state().header.stamp_ns, rig.now_ns);
  EXPECT_EQ(state().set_point, 1.0);
  EXPECT_EQ(state().process_value, 0.5);
  EXPECT_EQ(state().process_value_dot, 0.1);
  EXPECT_EQ(state().error, 0.5);
  EXPECT_EQ(state().time_step_s, Rig::kStep_s);
  EXPECT_EQ(state().command, rig.command_of("j"));
  EXPECT_EQ(state().p, 10.0);
  EXPECT_EQ(state().i, 3.0);
  EXPECT_EQ(state().d, 0.1);
  EXPECT_EQ(state().i_clamp, 2.0);
  EXPECT_TRUE(state().antiwindup);
  rig.update(9);
  EXPECT_EQ(rig.count("/base/state"), 1u);
  rig.update();
  EXPECT_EQ(rig.count("/base/state"), 2u);
}

TEST_F(PidController, TurnsAContinuousJointTheShortWay) {
  add_joint(JointInterface::kVelocity, JointType::kContinuous);
  rig.start("velocity_controllers/JointPositionController", parameters);
  rig.joint("j").position = 3.0;
  rig.send("/base/command", -3.0);  // the limits do not count here
  rig.update(2);
  EXPECT_NEAR(rig.command_of("j"), 10.0 * (2.0 * kPi - 6.0), 1e-9);
}

TEST_F(PidController, BringsAVelocity) {
  add_joint(JointInterface::kEffort, JointType::kContinuous);
  rig.joint("j").velocity = 2.0;
  rig.start("effort_controllers/JointVelocityController", parameters);
  rig.update(2);
  EXPECT_NEAR(rig.command_of("j"), -20.0, 1e-9);  // 0 before the first command
  rig.send("/base/command", 5.0);
  rig.update(2);
  EXPECT_NEAR(rig.command_of("j"), 30.0, 1e-9);
  EXPECT_EQ(state().process_value, 2.0);
}

TEST_F(PidController, BringsAGroupEachJointByItsOwnGains) {
  rig.add_joint("a", JointInterface::kEffort, JointType::kPrismatic);
  rig.add_joint("b", JointInterface::kEffort, JointType::kPrismatic);
  rig.start("effort_controllers/JointGroupPositionController",
            {{"joints", names({"a", "b"})}, {"a/pid/p", 2.0}, {"b/pid/p", 3.0}});
  rig.send("/base/command", std::vector<double>{1.0, 1.0});
  rig.update();
  EXPECT_EQ(rig.command_of("a"), 2.0);
  EXPECT_EQ(rig.command_of("b"), 3.0);
  EXPECT_FALSE(rig.publishes("/base/state"));
  EXPECT_EQ(rig.controller->ports().all<ParameterGroup>()[1].get().name, "/base/b/pid");
}

TEST_F(PidController, MayBeTunedUntilAReset) {
  add_joint(JointInterface::kEffort, JointType::kContinuous);
  rig.start("effort_controllers/JointVelocityController", parameters);
  rig.tunable("p").set(1.0);
  rig.send("/base/command", 1.0);
  rig.update(2);
  EXPECT_NEAR(rig.command_of("j"), 1.0, 1e-9);
  rig.controller->reset(rig.now_ns);
  EXPECT_EQ(rig.tunable("p").get(), 10.0);
}

TEST_F(PidController, SaysWhichParameterIsMissing) {
  add_joint(JointInterface::kEffort, JointType::kContinuous);
  parameters.erase("pid/p");
  EXPECT_EQ(rig.refusal("effort_controllers/JointPositionController", parameters),
            "/base/pid/p: found nothing, expected a number");
}

TEST_F(PidController, GoesOnFromASavedState) {
  add_joint(JointInterface::kVelocity, JointType::kRevolute);
  parameters["pid/i"] = 5.0;
  parameters["pid/i_clamp"] = 1.0;
  rig.start("velocity_controllers/JointPositionController", parameters);
  rig.send("/base/command", 0.8);
  rig.tunable("p").set(7.0);
  rig.roll(5);
  rig.expect_repeats(20);
}

}  // namespace
}  // namespace ardee::control
