// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "ardee_sim/devices/control_readings.h"

namespace ardee::devices {

/// Server's handle of a client's goal. A goal is accepted or rejected on arrival, and ends once:
/// succeeded, aborted or cancelled. Calls do nothing after its end, or when the client is gone.
template <typename Result, typename Feedback>
class GoalHandle {
 public:
  virtual ~GoalHandle() = default;
  virtual void accept() = 0;
  virtual void reject(const Result& result, const std::string& why) = 0;
  virtual void feed_back(const Feedback& feedback) = 0;
  virtual void succeed(const Result& result) = 0;
  virtual void abort(const Result& result) = 0;
  /// Ends the goal at the client's request, or because another goal takes its place.
  virtual void cancel() = 0;
};

/// Action of a device: a request that takes some time, as in ROS's actionlib. `on_goal` and
/// `on_cancel` are called between two steps.
template <typename GoalType, typename ResultType, typename FeedbackType>
struct ActionOf {
  using Goal = GoalType;
  using Result = ResultType;
  using Feedback = FeedbackType;
  using Handle = GoalHandle<Result, Feedback>;
  using HandlePtr = std::shared_ptr<Handle>;  // one address as long as the goal lives

  std::string name;
  std::function<void(const Goal&, const HandlePtr&)> on_goal;
  std::function<void(const HandlePtr&)> on_cancel;
};

/// Tolerance of a joint's error: > 0, in the joint's units; 0: by the controller's parameters; < 0:
/// unlimited.
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

/// Desired state of joints at a time, by their names (control_msgs/QueryTrajectoryState).
struct TrajectoryState {
  std::vector<std::string> names;
  std::vector<double> positions;
  std::vector<double> velocities;
  std::vector<double> accelerations;
};

}  // namespace ardee::devices
