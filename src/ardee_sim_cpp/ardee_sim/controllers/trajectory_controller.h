// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ardee_sim/controllers/controller.h"
#include "ardee_sim/controllers/pid.h"
#include "ardee_sim/controllers/trajectory.h"

namespace ardee::control {

/// Moves joints along trajectories that come on "command" or as goals of "follow_joint_trajectory":
/// {position, velocity, effort}_controllers/JointTrajectoryController. Position commands are the
/// desired positions; velocity and effort commands are a PID law of the error plus a share of the
/// desired velocity.
class TrajectoryController : public Controller {
 public:
  /// {pos_vel, pos_vel_acc}_controllers/JointTrajectoryController need interfaces that the
  /// simulated hardware lacks, here as in Gazebo. Throws Error.
  static std::unique_ptr<Controller> make_pos_vel(const ControllerContext& context);
  static std::unique_ptr<Controller> make_pos_vel_acc(const ControllerContext& context);

  TrajectoryController(const ControllerContext& context, JointInterface interface);

  /// Holds the joints at their present positions.
  void start(TimeNs now_ns) override;
  void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) override;
  void stop(TimeNs now_ns) override;
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override {
    state(state_timer_, feedback_timer_, now_ns_, period_ns_, uptime_ns_, goal_number_);
    for (Joint& each : joints_) state(each.pid, each.path, each.desired, each.has_arrived);
  }

 private:
  using Result = devices::FollowTrajectoryResult;
  struct Joint {
    JointHandle& handle;
    SegmentTolerance tolerance;  // of goals that give none
    std::optional<Pid> pid;      // none: positions are commanded
    double velocity_share = 0.0;
    JointPath path;
    JointMotion desired;
    bool has_arrived = false;  // it has been within the tolerance of the goal
  };

  void add_joint(const ControllerContext& context, const std::string& name,
                 JointInterface interface);
  double next_uptime_s() const { return seconds(uptime_ns_ + period_ns_); }
  double to_uptime_s(double time_s) const {
    return time_s - seconds(now_ns_) + seconds(uptime_ns_);
  }
  void require_running() const;
  /// Index in `names` of each joint, none if it is absent. Throws Error for a name that is not one
  /// of the joints.
  std::vector<std::optional<std::size_t>> places(const std::vector<std::string>& names) const;
  std::vector<SegmentTolerance> tolerances(const devices::FollowTrajectoryGoal& goal);

  /// Follows a trajectory from the next update on. Throws Error if that is impossible, and changes
  /// nothing then.
  void follow(const devices::JointTrajectory& trajectory,
              const std::vector<SegmentTolerance>& tolerances, std::uint64_t goal);
  void hold(std::uint64_t goal);
  void on_command(const devices::JointTrajectory& trajectory);
  void on_goal(const devices::FollowTrajectoryGoal& goal,
               const devices::FollowTrajectoryAction::HandlePtr& handle);
  void on_cancel(const devices::FollowTrajectoryAction::HandlePtr& handle);
  void preempt();
  devices::TrajectoryState state_at(double time_s) const;

  /// Violation of the goal's tolerances by the joint, if its segment belongs to the goal.
  std::optional<Result> violation(Joint& joint, const Segment& segment, const JointMotion& error);
  void end_goal(const std::optional<Result>& failure);
  void publish(devices::TrajectoryControllerReading& state, devices::ReadingSink& sink);

  Log& log_;
  bool allows_partial_goals_;
  double stop_duration_s_;
  std::deque<Joint> joints_;  // tunings point to them
  devices::Output* state_output_;
  PublishTimer state_timer_;
  PublishTimer feedback_timer_;

  TimeNs now_ns_ = 0;
  TimeNs period_ns_ = 0;
  TimeNs uptime_ns_ = 0;  // sum of all periods since the start: the time of the paths
  devices::FollowTrajectoryAction::HandlePtr goal_;
  std::uint64_t goal_number_ = 0;  // of the latest goal
};

}  // namespace ardee::control
