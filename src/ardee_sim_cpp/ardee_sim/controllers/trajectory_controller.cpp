// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/trajectory_controller.h"

#include <algorithm>
#include <set>
#include <utility>

#include "ardee_sim/controllers/joint_error.h"
#include "ardee_sim/core/error.h"

namespace ardee::control {
namespace {

Error lacking(const ControllerContext& context, const std::string& interface) {
  return Error(context.settings.path() + "/type: found a controller that needs the " + interface +
               ", which the simulated hardware lacks, as gazebo_ros_control's DefaultRobotHWSim "
               "does, expected position_controllers/, velocity_controllers/ or "
               "effort_controllers/JointTrajectoryController instead");
}

/// Replaces a tolerance of the parameters by the goal's.
void override_tolerance(double given, double& tolerance) {
  if (given != 0.0) tolerance = std::max(given, 0.0);
}

void override_tolerance(const devices::JointTolerance& given, StateTolerance& tolerance) {
  override_tolerance(given.position, tolerance.position);
  override_tolerance(given.velocity, tolerance.velocity);
  override_tolerance(given.acceleration, tolerance.acceleration);
}

double position_difference(const JointHandle& joint, double desired) {
  const double difference = desired - joint.position;
  return turns(joint.type) ? shortest_turn(difference) : difference;
}

void append(const JointMotion& motion, bool has_acceleration,
            devices::JointTrajectoryPoint& point) {
  point.positions.push_back(motion.position);
  point.velocities.push_back(motion.velocity);
  if (has_acceleration) point.accelerations.push_back(motion.acceleration);
}

Waypoint waypoint(const devices::JointTrajectoryPoint& point, std::size_t place) {
  const auto if_any = [place](const std::vector<double>& numbers) {
    return numbers.empty() ? std::nullopt : std::optional<double>(numbers[place]);
  };
  return {point.positions[place], if_any(point.velocities), if_any(point.accelerations)};
}

}  // namespace

std::unique_ptr<Controller> TrajectoryController::make_pos_vel(const ControllerContext& context) {
  throw lacking(context, "hardware_interface::PosVelJointInterface");
}
std::unique_ptr<Controller> TrajectoryController::make_pos_vel_acc(
    const ControllerContext& context) {
  throw lacking(context, "hardware_interface::PosVelAccJointInterface");
}

TrajectoryController::TrajectoryController(const ControllerContext& context,
                                           JointInterface interface)
    : log_(context.log),
      allows_partial_goals_(context.settings.boolean("allow_partial_joints_goal", false)),
      stop_duration_s_(std::max(context.settings.number("stop_trajectory_duration", 0.0), 0.0)),
      state_output_(&ports().add_output(
          context.topic("state"), devices::reading_kind<devices::TrajectoryControllerReading>())),
      state_timer_(context.settings.number("state_publish_rate", 50.0)),
      feedback_timer_(context.settings.number("action_monitor_rate", 20.0)) {
  const std::vector<std::string> names = context.settings.texts("joints");
  if (names.empty()) throw Error(context.settings.path() + "/joints: found none, expected some");
  for (const std::string& name : names) add_joint(context, name, interface);

  ports().add_input<devices::JointTrajectory>(
      context.topic("command"),
      [this](const devices::JointTrajectory& trajectory) { on_command(trajectory); });
  devices::FollowTrajectoryAction action;
  action.name = context.topic("follow_joint_trajectory");
  action.on_goal = [this](const devices::FollowTrajectoryGoal& goal,
                          const devices::FollowTrajectoryAction::HandlePtr& handle) {
    on_goal(goal, handle);
  };
  action.on_cancel = [this](const devices::FollowTrajectoryAction::HandlePtr& handle) {
    on_cancel(handle);
  };
  ports().add<devices::Action>(std::move(action));
  const std::function<devices::TrajectoryState(double)> query = [this](double time_s) {
    return state_at(time_s);
  };
  ports().add(devices::Service{context.topic("query_state"), query});
}

void TrajectoryController::add_joint(const ControllerContext& context, const std::string& name,
                                     JointInterface interface) {
  const Setting& settings = context.settings;
  const Setting limits = settings.at("constraints");
  JointHandle& handle = claim(context, name, interface, settings.at("joints"));
  Joint& joint = joints_.emplace_back(Joint{handle, {}, {}, 0.0, {}, {}, false});
  joint.tolerance.path.position = limits.number(name + "/trajectory", 0.0);
  joint.tolerance.goal.position = limits.number(name + "/goal", 0.0);
  joint.tolerance.goal.velocity = limits.number("stopped_velocity_tolerance", 0.01);
  joint.tolerance.goal_time_s = limits.number("goal_time", 0.0);
  joint.path = resting_path(0.0, handle.position);
  if (interface == JointInterface::kPosition) return;
  const std::string group = "gains/" + name;
  joint.pid.emplace(read_pid_gains(settings.at(group), context.log));
  joint.velocity_share = settings.number("velocity_ff/" + name, 0.0);
  ports().add(joint.pid->tuning(context.topic(group)));
}

void TrajectoryController::start(TimeNs now_ns) {
  now_ns_ = now_ns;
  uptime_ns_ = period_ns_ = 0;
  state_timer_.start(0);
  feedback_timer_.start(0);
  for (Joint& joint : joints_) {
    joint.desired = {joint.handle.position, joint.handle.velocity, 0.0};
    if (joint.pid) joint.pid->reset();
  }
  hold(0);
}

void TrajectoryController::stop(TimeNs /*now_ns*/) { preempt(); }

void TrajectoryController::reset(TimeNs now_ns) {
  preempt();
  for (Joint& joint : joints_) {
    if (joint.pid) joint.pid->restore_gains();
  }
  start(now_ns);
}

void TrajectoryController::require_running() const {
  if (!is_running())
    throw Error("found a trajectory, expected none while the controller is stopped");
}

std::vector<std::optional<std::size_t>> TrajectoryController::places(
    const std::vector<std::string>& names) const {
  if (!allows_partial_goals_ && names.size() != joints_.size()) {
    throw Error("joint_names: found " + std::to_string(names.size()) + " joints, expected " +
                std::to_string(joints_.size()) + ", all of the controller's");
  }
  if (names.empty()) throw Error("joint_names: found none, expected joints of the controller");
  std::vector<std::optional<std::size_t>> found(joints_.size());
  for (std::size_t place = 0; place < names.size(); ++place) {
    const auto joint = std::find_if(joints_.begin(), joints_.end(), [&](const Joint& each) {
      return each.handle.name == names[place];
    });
    const bool is_known = joint != joints_.end();
    if (!is_known || found[static_cast<std::size_t>(joint - joints_.begin())]) {
      throw Error("joint_names: found '" + names[place] + "'" + (is_known ? " twice" : "") +
                  ", expected joints of the controller, each once");
    }
    found[static_cast<std::size_t>(joint - joints_.begin())] = place;
  }
  return found;
}

std::vector<SegmentTolerance> TrajectoryController::tolerances(
    const devices::FollowTrajectoryGoal& goal) {
  std::vector<SegmentTolerance> all;
  std::set<std::string> names;
  for (const Joint& joint : joints_) {
    SegmentTolerance& tolerance = all.emplace_back(joint.tolerance);
    names.insert(joint.handle.name);
    for (const devices::JointTolerance& given : goal.path_tolerances) {
      if (given.joint == joint.handle.name) override_tolerance(given, tolerance.path);
    }
    for (const devices::JointTolerance& given : goal.goal_tolerances) {
      if (given.joint == joint.handle.name) override_tolerance(given, tolerance.goal);
    }
    override_tolerance(goal.goal_time_tolerance_s, tolerance.goal_time_s);
  }
  for (const auto* list : {&goal.path_tolerances, &goal.goal_tolerances}) {
    for (const devices::JointTolerance& given : *list) {
      if (names.count(given.joint)) continue;
      log_.warn(state_output_->topic + ": a goal has a tolerance of '" + given.joint +
                "', which is no joint of the controller; it has no effect");
    }
  }
  return all;
}

void TrajectoryController::follow(const devices::JointTrajectory& trajectory,
                                  const std::vector<SegmentTolerance>& tolerances,
                                  std::uint64_t goal) {
  const std::vector<devices::JointTrajectoryPoint>& points = trajectory.points;
  if (points.empty()) return hold(goal);
  const auto found = places(trajectory.joints);
  check_points(points, trajectory.joints.size());
  const double next_s = next_uptime_s();
  const double start_s = trajectory.start_s ? to_uptime_s(*trajectory.start_s) : next_s;
  const auto is_ahead = [&](const devices::JointTrajectoryPoint& point) {
    return start_s + point.time_from_start_s > next_s;
  };
  const auto first = std::find_if(points.begin(), points.end(), is_ahead);
  if (first == points.end()) {
    throw Error("points: found the last one " +
                std::to_string(next_s - start_s - points.back().time_from_start_s) +
                " s before the next update, expected one after it");
  }
  if (first != points.begin()) {
    log_.warn(state_output_->topic + ": the first " + std::to_string(first - points.begin()) +
              " points of a trajectory lie in the past and are dropped");
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    Joint& joint = joints_[i];
    joint.has_arrived = false;
    if (!found[i]) {  // continues its path, for the new goal
      for (Segment& segment : joint.path) segment.goal = goal;
      continue;
    }
    std::vector<TimedWaypoint> waypoints;
    for (auto point = first; point != points.end(); ++point) {
      waypoints.push_back({start_s + point->time_from_start_s, waypoint(*point, *found[i])});
    }
    joint.path = spliced_path(joint.path, next_s, start_s, std::move(waypoints),
                              !has_limits(joint.handle.type), goal, tolerances[i]);
  }
}

void TrajectoryController::hold(std::uint64_t goal) {
  for (Joint& joint : joints_) {
    const double now_s = seconds(uptime_ns_);
    joint.path = stop_duration_s_ > 0.0 ? stopping_path(now_s, joint.desired, stop_duration_s_)
                                        : resting_path(now_s, joint.handle.position);
    joint.path.front().goal = goal;
    joint.has_arrived = false;
  }
}

void TrajectoryController::on_command(const devices::JointTrajectory& trajectory) {
  require_running();
  follow(trajectory, tolerances({}), 0);
  preempt();
}

void TrajectoryController::on_goal(const devices::FollowTrajectoryGoal& goal,
                                   const devices::FollowTrajectoryAction::HandlePtr& handle) {
  Result::Code code = Result::kInvalidGoal;
  try {
    require_running();
    code = Result::kInvalidJoints;
    places(goal.trajectory.joints);
    code = Result::kInvalidGoal;
    follow(goal.trajectory, tolerances(goal), goal_number_ + 1);
  } catch (const Error& error) {
    log_.error(state_output_->topic + ": a goal is rejected: " + error.what());
    handle->reject({code, error.what()}, error.what());
    return;
  }
  preempt();
  handle->accept();
  goal_ = handle;
  ++goal_number_;
}

void TrajectoryController::on_cancel(const devices::FollowTrajectoryAction::HandlePtr& handle) {
  if (handle != goal_) return;
  hold(0);
  preempt();
}

void TrajectoryController::preempt() {
  if (goal_) std::exchange(goal_, nullptr)->cancel();
}

devices::TrajectoryState TrajectoryController::state_at(double time_s) const {
  require_running();
  const double uptime_s = to_uptime_s(time_s);
  devices::TrajectoryState state;
  for (const Joint& joint : joints_) {
    const Segment& segment = segment_at(joint.path, uptime_s);
    if (uptime_s < segment.start_s()) {
      throw Error("time: found " + std::to_string(time_s) +
                  " s, which lies before the trajectory that is followed");
    }
    const JointMotion motion = segment.at(uptime_s);
    state.names.push_back(joint.handle.name);
    state.positions.push_back(motion.position);
    state.velocities.push_back(motion.velocity);
    state.accelerations.push_back(motion.acceleration);
  }
  return state;
}

void TrajectoryController::update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) {
  now_ns_ = now_ns;
  period_ns_ = nanoseconds(period_s);
  uptime_ns_ += period_ns_;
  const double uptime_s = seconds(uptime_ns_);
  devices::TrajectoryControllerReading state;
  state.header.stamp_ns = now_ns;
  std::optional<Result> failure;
  for (Joint& joint : joints_) {
    JointHandle& handle = joint.handle;
    const Segment& segment = segment_at(joint.path, uptime_s);
    joint.desired = segment.at(uptime_s);
    const JointMotion error{position_difference(handle, joint.desired.position),
                            joint.desired.velocity - handle.velocity, 0.0};
    if (goal_ && !failure) failure = violation(joint, segment, error);
    handle.command = joint.pid ? joint.velocity_share * joint.desired.velocity +
                                     joint.pid->update(error.position, error.velocity, period_s)
                               : joint.desired.position;
    state.names.push_back(handle.name);
    append(joint.desired, true, state.desired);
    append({handle.position, handle.velocity, 0.0}, false, state.actual);
    append(error, false, state.error);
  }
  if (goal_ && feedback_timer_.due(uptime_ns_)) goal_->feed_back(state);
  end_goal(failure);
  if (state_timer_.due(uptime_ns_) && state_output_->demanded) {
    sink.on_reading(*state_output_, state);
  }
}

std::optional<devices::FollowTrajectoryResult> TrajectoryController::violation(
    Joint& joint, const Segment& segment, const JointMotion& error) {
  if (segment.goal != goal_number_) return std::nullopt;
  const double uptime_s = seconds(uptime_ns_);
  const SegmentTolerance& tolerance = segment.tolerance;
  const std::string& name = joint.handle.name;
  const std::string by = std::to_string(error.position);
  if (uptime_s < segment.end_s()) {
    if (tolerance.path.allows(error)) return std::nullopt;
    return Result{Result::kPathToleranceViolated, name + " path error " + by};
  }
  if (&segment != &joint.path.back()) return std::nullopt;
  if (tolerance.goal.allows(error)) {
    joint.has_arrived = true;
  } else if (uptime_s >= segment.end_s() + tolerance.goal_time_s) {
    return Result{Result::kGoalToleranceViolated, name + " goal error " + by};
  }
  return std::nullopt;
}

void TrajectoryController::end_goal(const std::optional<Result>& failure) {
  if (!goal_) return;
  if (failure) {
    std::exchange(goal_, nullptr)->abort(*failure);
  } else if (std::all_of(joints_.begin(), joints_.end(),
                         [](const Joint& joint) { return joint.has_arrived; })) {
    std::exchange(goal_, nullptr)->succeed({});
  }
}

}  // namespace ardee::control
