// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ardee_sim/controllers/joint_limits.h"
#include "ardee_sim/core/error.h"

namespace ardee::control {
namespace {

constexpr double kNone = CommandLimits::kNone;

JointHandle handle(JointInterface interface, double position = 0.0, double velocity = 0.0) {
  JointHandle joint;
  joint.name = "j";
  joint.interface = interface;
  joint.position = position;
  joint.velocity = velocity;
  return joint;
}

double enforced(CommandLimiter& limiter, JointHandle& joint, double command, double dt_s = 0.1) {
  joint.command = command;
  limiter.enforce(joint, dt_s);
  return joint.command;
}

double enforced_once(const CommandLimits& limits, JointHandle joint, double command) {
  CommandLimiter limiter(limits);
  return enforced(limiter, joint, command);
}

TEST(JointLimits, PositionsRampAtTheGreatestVelocityFromWhereTheJointIs) {
  CommandLimiter limiter({-1.0, 1.0, 2.0, kNone, kNone, std::nullopt});
  JointHandle joint = handle(JointInterface::kPosition, 0.5);
  EXPECT_DOUBLE_EQ(enforced(limiter, joint, 9.0), 0.7);
  EXPECT_DOUBLE_EQ(enforced(limiter, joint, 9.0), 0.9);
  EXPECT_DOUBLE_EQ(enforced(limiter, joint, 9.0), 1.0);
  EXPECT_DOUBLE_EQ(enforced(limiter, joint, -9.0), 0.8);
  limiter.reset();
  EXPECT_DOUBLE_EQ(enforced(limiter, joint, 9.0), 0.7);
}

TEST(JointLimits, VelocitiesRampAtTheGreatestAcceleration) {
  CommandLimiter limiter({-kNone, kNone, 1.0, 4.0, kNone, std::nullopt});
  JointHandle joint = handle(JointInterface::kVelocity);
  EXPECT_DOUBLE_EQ(enforced(limiter, joint, 5.0), 0.4);
  EXPECT_DOUBLE_EQ(enforced(limiter, joint, 5.0), 0.8);
  EXPECT_DOUBLE_EQ(enforced(limiter, joint, 5.0), 1.0);
  EXPECT_DOUBLE_EQ(enforced(limiter, joint, -5.0), 0.6);
  limiter.reset();
  EXPECT_DOUBLE_EQ(enforced(limiter, joint, -5.0), -0.4);
}

TEST(JointLimits, VelocitiesWithoutLimitOfAccelerationJump) {
  const CommandLimits limits{-kNone, kNone, 1.5, kNone, kNone, std::nullopt};
  EXPECT_DOUBLE_EQ(enforced_once(limits, handle(JointInterface::kVelocity), -9.0), -1.5);
  EXPECT_DOUBLE_EQ(enforced_once({}, handle(JointInterface::kVelocity), -9.0), -9.0);
}

TEST(JointLimits, NoEffortPushesOutwardsBeyondALimit) {
  const CommandLimits limits{-1.0, 1.0, 2.0, kNone, 10.0, std::nullopt};
  const auto within = [&limits](double position, double velocity, double command) {
    return enforced_once(limits, handle(JointInterface::kEffort, position, velocity), command);
  };
  EXPECT_DOUBLE_EQ(within(0.0, 0.0, 30.0), 10.0);
  EXPECT_DOUBLE_EQ(within(0.0, 0.0, -30.0), -10.0);
  EXPECT_DOUBLE_EQ(within(1.1, 0.0, 5.0), 0.0);
  EXPECT_DOUBLE_EQ(within(1.1, 0.0, -5.0), -5.0);
  EXPECT_DOUBLE_EQ(within(-1.1, 0.0, -5.0), 0.0);
  EXPECT_DOUBLE_EQ(within(0.0, 2.1, 5.0), 0.0);
  EXPECT_DOUBLE_EQ(within(0.0, -2.1, -5.0), 0.0);
  EXPECT_DOUBLE_EQ(within(0.0, -2.1, 5.0), 5.0);
}

TEST(JointLimits, SoftLimitsSlowDownBeforeTheEnd) {
  // 0.1 rad short of the soft limit at 2 1/s: 0.2 rad/s are left.
  const CommandLimits limits{-1.0, 1.0, 3.0, kNone, 10.0, SafetyLimits{-0.8, 0.8, 2.0, 5.0}};
  EXPECT_NEAR(enforced_once(limits, handle(JointInterface::kVelocity, 0.7), 9.0), 0.2, 1e-12);
  EXPECT_NEAR(enforced_once(limits, handle(JointInterface::kVelocity, 0.7), -9.0), -3.0, 1e-12);
  EXPECT_NEAR(enforced_once(limits, handle(JointInterface::kVelocity, 0.9), 9.0), -0.2, 1e-12);
  EXPECT_NEAR(enforced_once(limits, handle(JointInterface::kPosition, 0.7), 9.0), 0.72, 1e-12);
  // The effort is 5 N m s/rad times the velocity missing to 0.2 rad/s, 0.1 rad/s.
  EXPECT_NEAR(enforced_once(limits, handle(JointInterface::kEffort, 0.7, 0.1), 9.0), 0.5, 1e-12);
  EXPECT_NEAR(enforced_once(limits, handle(JointInterface::kEffort, 0.7, 0.3), 9.0), -0.5, 1e-12);
}

TEST(JointLimits, SoftVelocitiesRampFromTheMeasuredOne) {
  const CommandLimits limits{-kNone, kNone, 3.0, 1.0, kNone, SafetyLimits{0.0, 0.0, 2.0, 5.0}};
  EXPECT_NEAR(enforced_once(limits, handle(JointInterface::kVelocity, 0.0, 2.0), 9.0), 2.1, 1e-12);
}

class ReadJointLimits : public ::testing::Test {
 protected:
  CommandLimits read(Setting::Map map) {
    Joint joint;
    joint.axis.lower = -1.0;
    joint.axis.upper = 2.0;
    joint.axis.velocity = 3.0;
    joint.axis.effort = 4.0;
    joint.safety = SafetyLimits{-0.5, 0.5, 6.0, 7.0};
    return read_command_limits(joint, {"/joint_limits/j", std::move(map)}, log_);
  }
  std::vector<std::string> said_;
  Log log_{[this](LogLevel, const std::string& text) { said_.push_back(text); }};
};

TEST_F(ReadJointLimits, TakesThoseOfTheDescription) {
  const CommandLimits limits = read({});
  EXPECT_EQ(limits.min_position, -1.0);
  EXPECT_EQ(limits.max_position, 2.0);
  EXPECT_EQ(limits.max_velocity, 3.0);
  EXPECT_EQ(limits.max_acceleration, kNone);
  EXPECT_EQ(limits.max_effort, 4.0);
  EXPECT_EQ(limits.soft->k_velocity, 7.0);
}

TEST_F(ReadJointLimits, TakesWhatParametersSayInstead) {
  const CommandLimits limits = read({{"has_position_limits", {"", true}},
                                     {"min_position", {"", -9.0}},
                                     {"max_position", {"", 9}},
                                     {"has_velocity_limits", {"", true}},
                                     {"max_velocity", {"", 0.5}},
                                     {"has_acceleration_limits", {"", true}},
                                     {"max_acceleration", {"", 8.0}},
                                     {"has_effort_limits", {"", true}},
                                     {"max_effort", {"", 100.0}}});
  EXPECT_EQ(limits.min_position, -9.0);
  EXPECT_EQ(limits.max_position, 9.0);
  EXPECT_EQ(limits.max_velocity, 0.5);
  EXPECT_EQ(limits.max_acceleration, 8.0);
  EXPECT_EQ(limits.max_effort, 100.0);
}

TEST_F(ReadJointLimits, TakesLimitsAway) {
  const CommandLimits limits = read({{"has_position_limits", {"", false}},
                                     {"has_velocity_limits", {"", false}},
                                     {"has_effort_limits", {"", false}}});
  EXPECT_FALSE(limits.has_position());
  EXPECT_EQ(limits.max_velocity, kNone);
  EXPECT_EQ(limits.max_effort, kNone);
  EXPECT_TRUE(said_.empty());
}

TEST_F(ReadJointLimits, NeedsBothPartsOfALimit) {
  const CommandLimits limits =
      read({{"max_velocity", {"", 0.5}}, {"has_effort_limits", {"", true}}});
  EXPECT_EQ(limits.max_velocity, 3.0);
  EXPECT_EQ(limits.max_effort, 4.0);
}

TEST_F(ReadJointLimits, SaysWhatHasNoEffectAndWhatIsNoNumber) {
  read({{"has_jerk_limits", {"/joint_limits/j/has_jerk_limits", true}}});
  ASSERT_EQ(said_.size(), 1u);
  EXPECT_EQ(said_[0].rfind("/joint_limits/j/has_jerk_limits has no effect", 0), 0u);
  EXPECT_THROW(read({{"has_velocity_limits", {"", 1}}}), Error);
  EXPECT_THROW(read({{"has_effort_limits", {"", true}}, {"max_effort", {"", -1.0}}}), Error);
  EXPECT_THROW(
      read({{"has_velocity_limits", {"", true}}, {"max_velocity", {"", std::string("x")}}}), Error);
}

}  // namespace
}  // namespace ardee::control
