// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "ardee_sim/devices/control_readings.h"

namespace ardee::devices {

/// A goal of an action that a client has set, as its server sees it. A goal is accepted or rejected
/// when it comes, and ends once: succeeded, aborted or cancelled. After its end, or when the client
/// is gone, calls do nothing.
template <typename Result, typename Feedback>
class GoalHandle {
 public:
  virtual ~GoalHandle() = default;
  virtual void accept() = 0;
  virtual void reject(const Result& result, const std::string& why) = 0;
  virtual void feed_back(const Feedback& feedback) = 0;
  virtual void succeed(const Result& result) = 0;
  virtual void abort(const Result& result) = 0;
  /// At the client's wish, or because another goal takes its place.
  virtual void cancel() = 0;
};

/// Something that a device does over some time when asked, as ROS's actionlib has it. `on_goal`
/// and `on_cancel` are called between two steps.
template <typename GoalType, typename ResultType, typename FeedbackType>
struct ActionOf {
  using Goal = GoalType;
  using Result = ResultType;
  using Feedback = FeedbackType;
  using Handle = GoalHandle<Result, Feedback>;
  using HandlePtr = std::shared_ptr<Handle>;  // the same as long as the goal lives

  std::string name;
  std::function<void(const Goal&, const HandlePtr&)> on_goal;
  std::function<void(const HandlePtr&)> on_cancel;
};

/// How far a joint may be from where it shall be: > 0, in the joint's units; 0: as the controller's
/// parameters say; < 0: as far as it likes.
struct JointTolerance {
  std::string joint;
  double position = 0.0;
  double velocity = 0.0;
  double acceleration = 0.0;
};

/// control_msgs/FollowJointTrajectory.
struct FollowTrajectoryGoal {
  JointTrajectory trajectory;
  std::vector<JointTolerance> path_tolerances;
  std::vector<JointTolerance> goal_tolerances;
  double goal_time_tolerance_s = 0.0;
};
struct FollowTrajectoryResult {
  enum Code {
    kSuccessful = 0,
    kInvalidGoal = -1,
    kInvalidJoints = -2,
    kPathToleranceViolated = -4,
    kGoalToleranceViolated = -5
  };
  Code code = kSuccessful;
  std::string text;
};
using FollowTrajectoryAction =
    ActionOf<FollowTrajectoryGoal, FollowTrajectoryResult, TrajectoryControllerReading>;

/// control_msgs/GripperCommand: rad or m, N m or N.
struct GripperGoal {
  double position = 0.0;
  double max_effort = 0.0;
};
struct GripperState {
  double position = 0.0;
  double effort = 0.0;
  bool is_stalled = false;
  bool has_reached_goal = false;
};
using GripperAction = ActionOf<GripperGoal, GripperState, GripperState>;

using Action = std::variant<FollowTrajectoryAction, GripperAction>;

/// Where joints shall be at a time, by their names (control_msgs/QueryTrajectoryState).
struct TrajectoryState {
  std::vector<std::string> names;
  std::vector<double> positions;
  std::vector<double> velocities;
  std::vector<double> accelerations;
};

}  // namespace ardee::devices
