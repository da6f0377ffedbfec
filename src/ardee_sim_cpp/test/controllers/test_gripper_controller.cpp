// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include "recorded_goal.h"

namespace ardee::control {
using namespace devices;
namespace {

/// Gripper with one finger; steps of 0.01 s.
class Gripper : public Rig {
 public:
  using Goal = std::shared_ptr<RecordedGoal<GripperAction>>;

  explicit Gripper(JointInterface interface, Parameters parameters = {}) {
    add_joint("finger", interface, JointType::kPrismatic);
    parameters["joint"] = std::string("finger");
    const bool is_effort = interface == JointInterface::kEffort;
    if (is_effort) {
      parameters["gains/finger/p"] = 100.0;
      parameters["gains/finger/d"] = 10.0;
    }
    start(is_effort ? "effort_controllers/GripperActionController"
                    : "position_controllers/GripperActionController",
          parameters);
  }
  Goal grip(double position, double max_effort) {
    return send_goal<GripperAction>(*this, {position, max_effort});
  }
};

TEST(GripperController, SucceedsWithinTheToleranceOfItsGoal) {
  Gripper gripper(JointInterface::kPosition, {{"goal_tolerance", 0.02}});
  const auto goal = gripper.grip(0.05, 5.0);
  gripper.update();
  EXPECT_EQ(gripper.command_of("finger"), 0.05);
  gripper.joint("finger").position = 0.029;
  gripper.update();
  EXPECT_EQ(goal->state(), "accepted");
  gripper.joint("finger").position = 0.031;
  gripper.update();
  EXPECT_EQ(goal->state(), "succeeded");
  EXPECT_TRUE(goal->result.has_reached_goal);
  EXPECT_FALSE(goal->result.is_stalled);
  EXPECT_EQ(goal->result.position, 0.031);
  EXPECT_EQ(goal->result.effort, 5.0);
}

TEST(GripperController, LimitsTheEffortToThatOfTheGoal) {
  Gripper gripper(JointInterface::kEffort);
  gripper.joint("finger").velocity = 0.1;
  gripper.grip(0.05, 10.0);
  gripper.update();
  EXPECT_NEAR(gripper.command_of("finger"), 100.0 * 0.05 - 10.0 * 0.1, 1e-12);
  gripper.grip(0.05, 3.0);
  gripper.update();
  EXPECT_EQ(gripper.command_of("finger"), 3.0);
}

TEST(GripperController, AbortsWhenItStalls) {
  Gripper gripper(JointInterface::kEffort,
                  {{"stall_timeout", 0.5}, {"stall_velocity_threshold", 0.01}});
  const auto goal = gripper.grip(0.05, 2.0);
  gripper.joint("finger").velocity = 0.02;
  gripper.update(100);
  EXPECT_EQ(goal->state(), "accepted");
  gripper.joint("finger").velocity = 0.005;
  gripper.update(50);
  EXPECT_EQ(goal->state(), "accepted");
  gripper.update(1);
  EXPECT_EQ(goal->state(), "aborted");
  EXPECT_TRUE(goal->result.is_stalled);
  EXPECT_EQ(goal->result.effort, 2.0);
  EXPECT_EQ(goal->feedback.size(), 30u);  // 1.51 s at 20 Hz
}

TEST(GripperController, HoldsWhereItIsWhenAGoalIsCancelled) {
  Gripper gripper(JointInterface::kPosition);
  const auto first = gripper.grip(0.05, 2.0);
  const auto second = gripper.grip(0.04, 2.0);
  EXPECT_EQ(first->state(), "cancelled");
  gripper.joint("finger").position = 0.02;
  action_of<GripperAction>(gripper).on_cancel(second);
  EXPECT_EQ(second->state(), "cancelled");
  gripper.update();
  EXPECT_EQ(gripper.command_of("finger"), 0.02);
}

TEST(GripperController, HasNoEffortBeforeAGoalUnlessItsParametersSay) {
  for (const double max_effort : {0.0, -4.0}) {
    Gripper gripper(JointInterface::kEffort, {{"max_effort", max_effort}});
    gripper.joint("finger").position = -1.0;
    gripper.update();
    EXPECT_EQ(gripper.command_of("finger"), std::abs(max_effort));
  }
}

TEST(GripperController, RejectsGoalsThatAreNone) {
  Gripper gripper(JointInterface::kPosition);
  EXPECT_EQ(gripper.grip(std::numeric_limits<double>::quiet_NaN(), 1.0)->state(), "rejected");
  gripper.controller->set_running(false);
  EXPECT_EQ(gripper.grip(0.0, 1.0)->state(), "rejected");
}

TEST(GripperController, GoesOnFromASavedState) {
  Gripper gripper(JointInterface::kEffort);
  const auto goal = gripper.grip(0.05, 3.0);
  gripper.update(3);
  gripper.expect_repeats(20);
  EXPECT_EQ(goal->state(), "cancelled");
}

}  // namespace
}  // namespace ardee::control
