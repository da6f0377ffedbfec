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
/// {position, velocity, effort}_controllers/JointTrajectoryController. Positions are commanded as
/// they are desired; velocities and efforts by a PID law of the error, and a share of the desired
/// velocity.
class TrajectoryController : public Controller {
 public:
  static std::unique_ptr<Controller> make_position(const ControllerContext& context);
  static std::unique_ptr<Controller> make_velocity(const ControllerContext& context);
  static std::unique_ptr<Controller> make_effort(const ControllerContext& context);
  /// {pos_vel, pos_vel_acc}_controllers/JointTrajectoryController command interfaces that the
  /// simulated hardware lacks, here as in Gazebo: an Error.
  static std::unique_ptr<Controller> make_pos_vel(const ControllerContext& context);
  static std::unique_ptr<Controller> make_pos_vel_acc(const ControllerContext& context);

  TrajectoryController(const ControllerContext& context, JointInterface interface);

  /// Holds the joints where they are.
  void start(TimeNs now_ns) override;
  void update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) override;
  void stop(TimeNs now_ns) override;
  void reset(TimeNs now_ns) override;

 private:
  using Result = devices::FollowTrajectoryResult;
  struct Joint {
    JointHandle& handle;
    SegmentTolerance tolerance;  // of goals that say none
    std::optional<Pid> pid;      // none: positions are commanded
    double velocity_share = 0.0;
    JointPath path;
    JointMotion desired;
    bool has_arrived = false;  // within the tolerance of the goal, once
  };

  void add_joint(const ControllerContext& context, const std::string& name,
                 JointInterface interface);
  double next_uptime_s() const { return seconds(uptime_ns_ + period_ns_); }
  double to_uptime_s(double time_s) const {
    return time_s - seconds(now_ns_) + seconds(uptime_ns_);
  }
  void require_running() const;
  /// For each joint the place of its name, none if it is not among them. Throws Error for names
  /// that are not those of the joints.
  std::vector<std::optional<std::size_t>> places(const std::vector<std::string>& names) const;
  std::vector<SegmentTolerance> tolerances(const devices::FollowTrajectoryGoal& goal);

  /// From the next update on. Throws Error if there is no way to; then nothing has changed.
  void follow(const devices::JointTrajectory& trajectory,
              const std::vector<SegmentTolerance>& tolerances, std::uint64_t goal);
  void hold(std::uint64_t goal);
  void on_command(const devices::JointTrajectory& trajectory);
  void on_goal(const devices::FollowTrajectoryGoal& goal,
               const devices::FollowTrajectoryAction::HandlePtr& handle);
  void on_cancel(const devices::FollowTrajectoryAction::HandlePtr& handle);
  void preempt();
  devices::TrajectoryState state_at(double time_s) const;

  /// What is wrong with the joint for the goal, if its segment belongs to it.
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
  TimeNs uptime_ns_ = 0;  // the sum of all periods since the start: the clock of the paths
  devices::FollowTrajectoryAction::HandlePtr goal_;
  std::uint64_t goal_number_ = 0;  // of the latest goal
};

}  // namespace ardee::control
