// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "recorded_goal.h"

namespace ardee::control {
using namespace devices;
namespace {

/// Two joints and a controller of their positions; steps of 0.01 s.
class Arm : public Rig {
 public:
  using Goal = std::shared_ptr<RecordedGoal<FollowTrajectoryAction>>;

  explicit Arm(Parameters parameters = {}, JointType type = JointType::kRevolute) {
    add_joint("a", JointInterface::kPosition, type);
    add_joint("b", JointInterface::kPosition, type);
    parameters["joints"] = names({"a", "b"});
    start("position_controllers/JointTrajectoryController", parameters);
  }

  Goal follow(const FollowTrajectoryGoal& goal) {
    return send_goal<FollowTrajectoryAction>(*this, goal);
  }
  Goal follow(const JointTrajectory& trajectory) {
    return follow(FollowTrajectoryGoal{trajectory, {}, {}, 0.0});
  }
  void cancel(const Goal& goal) { action_of<FollowTrajectoryAction>(*this).on_cancel(goal); }
  /// Moves the joints to their commanded positions.
  void track(int steps) {
    for (int i = 0; i < steps; ++i) {
      update();
      for (auto& [name, joint] : hardware) joint.position = joint.command;
    }
  }
};

/// Returns a trajectory of both joints to positions within a time, along lines.
JointTrajectory to(double a, double b, double time_s) {
  return {std::nullopt, {"a", "b"}, {{{a, b}, {}, {}, {}, time_s}}};
}

TEST(TrajectoryController, HoldsWhereTheJointsAreAtItsStart) {
  Arm arm;
  arm.joint("a").position = 0.3;
  arm.controller->start(0);
  arm.update(5);
  EXPECT_EQ(arm.command_of("a"), 0.3);
}

TEST(TrajectoryController, CommandsThePositionsOfATrajectoryInAnyOrderOfJoints) {
  Arm arm;
  arm.send("/base/command", JointTrajectory{std::nullopt, {"b", "a"}, {{{2, 1}, {}, {}, {}, 1}}});
  arm.track(50);
  EXPECT_NEAR(arm.command_of("a"), 0.5, 1e-12);
  EXPECT_NEAR(arm.command_of("b"), 1.0, 1e-12);
  arm.track(100);
  EXPECT_NEAR(arm.command_of("a"), 1.0, 1e-12);
}

TEST(TrajectoryController, BeginsAtTheTimeOfAStampAndDropsPointsOfThePast) {
  Arm arm;
  arm.track(100);
  JointTrajectory later = to(1, 1, 1);
  later.start_s = 2.0;
  arm.send("/base/command", later);
  arm.track(100);  // 2 s
  EXPECT_NEAR(arm.command_of("a"), 0.0, 1e-12);
  arm.track(50);
  EXPECT_NEAR(arm.command_of("a"), 0.5, 1e-12);
  EXPECT_TRUE(arm.messages.empty());

  JointTrajectory earlier = to(0, 0, 1);  // at 2 s, 0.5 s ago
  earlier.start_s = 1.0;
  earlier.points.push_back({{2.49, 2.49}, {}, {}, {}, 3.5});  // at 4.5 s
  arm.send("/base/command", earlier);
  EXPECT_EQ(arm.messages.back(),
            "/base/state: the first 1 points of a trajectory lie in the past and are dropped");
  arm.track(1);
  EXPECT_NEAR(arm.command_of("a"), 0.51, 1e-12);  // the value without the trajectory
  arm.track(99);                                  // 3.5 s, half of the remaining way
  EXPECT_NEAR(arm.command_of("a"), 0.51 + 0.99 / 1.99 * (2.49 - 0.51), 1e-12);
}

TEST(TrajectoryController, CommandsAShareOfTheVelocityAndAPidOfTheError) {
  Rig rig;
  rig.add_joint("a", JointInterface::kEffort);
  const Parameters parameters{
      {"joints", names({"a"})}, {"velocity_ff/a", 3.0}, {"gains/a/p", 2.0}, {"gains/a/d", 0.5}};
  rig.start("effort_controllers/JointTrajectoryController", parameters);
  rig.send("/base/command", JointTrajectory{std::nullopt, {"a"}, {{{1}, {}, {}, {}, 1}}});
  rig.update(50);  // stuck at 0: the error is 0.5 rad, and 1 rad/s
  EXPECT_NEAR(rig.command_of("a"), 3.0 * 1.0 + 2.0 * 0.5 + 0.5 * 1.0, 1e-9);
  EXPECT_EQ(rig.tunable("p").get(), 2.0);
}

TEST(TrajectoryController, SucceedsWhenAllJointsAreThereAtTheEnd) {
  Arm arm;
  const auto goal = arm.follow(to(1, 2, 1));
  arm.track(99);
  EXPECT_EQ(goal->state(), "accepted");
  EXPECT_EQ(goal->feedback.size(), 19u);  // 20 Hz, the first after 0.05 s
  EXPECT_NEAR(goal->feedback.back().desired.positions[1], 1.92, 1e-12);
  arm.track(2);
  EXPECT_EQ(goal->state(), "succeeded");
  EXPECT_EQ(goal->result.code, FollowTrajectoryResult::kSuccessful);
}

TEST(TrajectoryController, AbortsWhereAJointLeavesThePath) {
  Arm arm({{"constraints/b/trajectory", 0.1}});
  const auto goal = arm.follow(to(0, 1, 1));  // the joints are stuck
  arm.update(10);
  EXPECT_EQ(goal->state(), "accepted");
  arm.update(1);
  EXPECT_EQ(goal->state(), "aborted");
  EXPECT_EQ(goal->result.code, -4);
  EXPECT_EQ(goal->result.text, "b path error 0.110000");
  arm.update(9);
  EXPECT_NEAR(arm.command_of("b"), 0.2, 1e-12);  // it continues
}

TEST(TrajectoryController, AbortsWhereAJointIsNotAtItsGoalInTime) {
  Arm arm({{"constraints/goal_time", 0.5}, {"constraints/a/goal", 0.1}});
  const auto goal = arm.follow(to(1, 0, 1));
  arm.update(149);
  EXPECT_EQ(goal->state(), "accepted");
  arm.update(1);
  EXPECT_EQ(goal->state(), "aborted");
  EXPECT_EQ(goal->result.code, -5);
  EXPECT_EQ(goal->result.text, "a goal error 1.000000");
}

TEST(TrajectoryController, NeedsJointsToStandStillAtTheGoal) {
  Arm arm;  // within 0.01 rad/s
  arm.joint("a").velocity = 0.02;
  const auto goal = arm.follow(to(0, 0, 0.5));
  arm.update(60);
  EXPECT_EQ(goal->result.code, -5);
}

TEST(TrajectoryController, TakesTolerancesOfTheGoalOverItsOwn) {
  Arm arm({{"constraints/a/trajectory", 0.1}, {"constraints/a/goal", 0.1}});
  FollowTrajectoryGoal free{to(1, 0, 1), {{"a", -1, 0, 0}}, {{"a", -1, 0, 0}}, 0.0};
  auto goal = arm.follow(free);
  arm.update(101);
  EXPECT_EQ(goal->state(), "succeeded");  // stuck, but without a tolerance
  arm.joint("a").position = 1.0;
  FollowTrajectoryGoal strict{to(0, 1, 1), {{"b", 0.5, 0, 0}, {"c", 1, 0, 0}}, {}, 0.0};
  goal = arm.follow(strict);
  EXPECT_EQ(arm.messages.back(),
            "/base/state: a goal has a tolerance of 'c', which is no joint of the controller; it "
            "has no effect");
  for (int i = 0; i < 53; ++i) {
    arm.update();
    arm.joint("a").position = arm.command_of("a");
  }
  EXPECT_EQ(goal->result.text.substr(0, 12), "b path error");
}

TEST(TrajectoryController, IsPreemptedByGoalsAndCommands) {
  Arm arm;
  const auto first = arm.follow(to(1, 1, 1));
  arm.track(50);
  const auto second = arm.follow(to(0, 0, 0.5));
  EXPECT_EQ(first->state(), "cancelled");
  arm.track(25);
  arm.send("/base/command", to(2, 2, 1));
  EXPECT_EQ(second->state(), "cancelled");
  const auto third = arm.follow(to(2, 2, 1));
  arm.controller->stop(0);
  EXPECT_EQ(third->state(), "cancelled");
}

TEST(TrajectoryController, HoldsWhereItIsWhenAGoalIsCancelled) {
  Arm arm;
  const auto goal = arm.follow(to(1, 1, 1));
  arm.track(50);
  arm.cancel(goal);
  EXPECT_EQ(goal->state(), "cancelled");
  arm.track(20);
  EXPECT_NEAR(arm.command_of("a"), 0.5, 1e-12);
}

TEST(TrajectoryController, StopsWithinADurationWhereThereIsOne) {
  Arm arm({{"stop_trajectory_duration", 0.4}});
  arm.send("/base/command", to(1, 1, 1));
  arm.track(50);
  arm.send("/base/command", JointTrajectory{});  // an empty one
  arm.track(100);
  EXPECT_NEAR(arm.command_of("a"), 0.5 + 0.625 * 1.0 * 0.4, 1e-12);
}

TEST(TrajectoryController, SucceedsAtOnceWithAnEmptyTrajectory) {
  Arm arm;
  arm.joint("a").position = 0.3;
  const auto goal = arm.follow(JointTrajectory{std::nullopt, {"a", "b"}, {}});
  arm.update(1);
  EXPECT_EQ(goal->state(), "succeeded");
  EXPECT_EQ(arm.command_of("a"), 0.3);
}

TEST(TrajectoryController, MovesSomeOfItsJointsWhereItMay) {
  const JointTrajectory partial{std::nullopt, {"b"}, {{{1}, {}, {}, {}, 1}}};
  Arm strict;
  const auto refused = strict.follow(partial);
  EXPECT_EQ(refused->state(), "rejected");
  EXPECT_EQ(refused->result.code, -2);
  EXPECT_EQ(refused->result.text,
            "joint_names: found 1 joints, expected 2, all of the controller's");

  Arm arm({{"allow_partial_joints_goal", true}});
  arm.send("/base/command", to(2, 0, 2));
  arm.track(50);
  const auto goal = arm.follow(partial);
  arm.track(50);
  EXPECT_NEAR(arm.command_of("a"), 1.0, 1e-12);   // continues its path
  EXPECT_NEAR(arm.command_of("b"), 0.49, 1e-12);  // from 0.51 s on
  arm.track(60);
  EXPECT_EQ(goal->state(), "accepted");
  arm.track(41);
  EXPECT_EQ(goal->state(), "succeeded");  // once a has arrived, too
}

TEST(TrajectoryController, RejectsGoalsThatAreNoneAndGoesOn) {
  Arm arm;
  const auto first = arm.follow(to(1, 1, 1));
  arm.track(50);
  const auto expect = [&](const JointTrajectory& trajectory, int code, const std::string& text) {
    const auto goal = arm.follow(trajectory);
    EXPECT_EQ(goal->state(), "rejected");
    EXPECT_EQ(goal->result.code, code);
    EXPECT_EQ(goal->result.text, text);
  };
  expect({std::nullopt, {"a", "c"}, {}}, -2,
         "joint_names: found 'c', expected joints of the controller, each once");
  expect({std::nullopt, {"a", "a"}, {}}, -2,
         "joint_names: found 'a' twice, expected joints of the controller, each once");
  expect({std::nullopt, {"a", "b"}, {{{1}, {}, {}, {}, 1}}}, -1,
         "points[0].positions: found 1 numbers, expected 2, one a joint");
  JointTrajectory past = to(1, 1, 0.1);
  past.start_s = 0.3;
  expect(past, -1,
         "points: found the last one 0.110000 s before the next update, expected one after it");
  arm.controller->set_running(false);
  expect(to(1, 1, 1), -1, "found a trajectory, expected none while the controller is stopped");
  EXPECT_EQ(message_of([&] { arm.send("/base/command", to(1, 1, 1)); }),
            "found a trajectory, expected none while the controller is stopped");
  EXPECT_EQ(first->state(), "accepted");
  arm.track(25);
  EXPECT_NEAR(arm.command_of("a"), 0.75, 1e-12);
}

TEST(TrajectoryController, TurnsContinuousJointsTheNearestWay) {
  Arm arm({}, JointType::kContinuous);
  arm.joint("a").position = 6.2;
  arm.controller->start(0);
  const auto goal = arm.follow(to(0.1, 0, 1));
  arm.track(101);
  EXPECT_NEAR(arm.command_of("a"), 0.1 + 2.0 * kPi, 1e-12);
  EXPECT_EQ(goal->state(), "succeeded");
}

TEST(TrajectoryController, TellsItsStateAtItsRate) {
  Arm arm({{"state_publish_rate", 10.0}});
  arm.send("/base/command", to(1, 2, 1));
  arm.update(52);  // stuck
  EXPECT_EQ(arm.count("/base/state"), 5u);
  const auto& state = arm.last<TrajectoryControllerReading>("/base/state");
  EXPECT_EQ(state.header.stamp_ns, 510'000'000);
  EXPECT_EQ(state.names, (std::vector<std::string>{"a", "b"}));
  EXPECT_NEAR(state.desired.positions[1], 1.02, 1e-12);
  EXPECT_NEAR(state.error.positions[0], 0.51, 1e-12);
  EXPECT_NEAR(state.error.velocities[0], 1.0, 1e-12);
  EXPECT_EQ(state.actual.positions[0], 0.0);
}

TEST(TrajectoryController, AnswersWhereTheJointsWillBe) {
  Arm arm;
  arm.track(100);
  arm.send("/base/command", to(1, 2, 1));
  const Service& query = arm.controller->ports().all<Service>().at(0);
  EXPECT_EQ(query.name, "/base/query_state");
  const auto& state_at = std::get<std::function<TrajectoryState(double)>>(query.act);
  // From the next update, 1.01 s, to 2.01 s.
  EXPECT_NEAR(state_at(1.51).positions[1], 1.0, 1e-9);
  EXPECT_NEAR(state_at(3.0).velocities[1], 0.0, 1e-12);
}

TEST(TrajectoryController, RefusesWhatItCannotBeMadeWith) {
  Rig rig;
  rig.add_joint("a", JointInterface::kVelocity);
  EXPECT_EQ(
      rig.refusal("position_controllers/JointTrajectoryController", {{"joints", names({"a"})}}),
      "/base/joints: joint 'a' has the hardware_interface::VelocityJointInterface, expected "
      "the hardware_interface::PositionJointInterface");
  EXPECT_EQ(
      rig.refusal("velocity_controllers/JointTrajectoryController", {{"joints", names({"a"})}}),
      "/base/gains/a/p: found nothing, expected a number");
  EXPECT_EQ(rig.refusal("velocity_controllers/JointTrajectoryController", {{"joints", names({})}}),
            "/base/joints: found none, expected some");
  EXPECT_EQ(rig.refusal("pos_vel_controllers/JointTrajectoryController", {}),
            "/base/type: found a controller that needs the "
            "hardware_interface::PosVelJointInterface, which the simulated hardware lacks, as "
            "gazebo_ros_control's DefaultRobotHWSim does, expected position_controllers/, "
            "velocity_controllers/ or effort_controllers/JointTrajectoryController instead");
}

TEST(TrajectoryController, GoesOnFromASavedState) {
  Arm arm;
  arm.send("/base/command", to(1, -1, 2));
  arm.track(50);
  arm.expect_repeats(100);
}

}  // namespace
}  // namespace ardee::control
