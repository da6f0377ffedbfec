// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "ardee_sim/devices/command.h"

namespace ardee::control {

/// State of motion of a joint at one time: rad or m, and their derivatives.
struct JointMotion {
  double position = 0.0;
  double velocity = 0.0;
  double acceleration = 0.0;
};

/// An end of a segment; velocity and acceleration are optional.
struct Waypoint {
  double position = 0.0;
  std::optional<double> velocity;
  std::optional<double> acceleration;

  Waypoint() = default;
  Waypoint(double at, std::optional<double> rate, std::optional<double> rate_of_rate)
      : position(at), velocity(rate), acceleration(rate_of_rate) {}
  explicit Waypoint(const JointMotion& motion)
      : position(motion.position), velocity(motion.velocity), acceleration(motion.acceleration) {}
};

/// Tolerances of a joint's errors; 0: unlimited.
struct StateTolerance {
  double position = 0.0;
  double velocity = 0.0;
  double acceleration = 0.0;

  bool allows(const JointMotion& error) const;
};

struct SegmentTolerance {
  StateTolerance path;
  StateTolerance goal;
  double goal_time_s = 0.0;  // time after the end to come within `goal`
};

/// Path of one joint between two times: a line if the ends have positions only, a cubic polynomial
/// if both have velocities, a quintic if both have accelerations.
class Segment {
 public:
  Segment() = default;
  /// Requires start_s <= end_s.
  Segment(double start_s, const Waypoint& start, double end_s, const Waypoint& end);

  double start_s() const { return start_s_; }
  double end_s() const { return start_s_ + duration_s_; }
  /// Motion at a time; before the start and from the end on: at rest, at the nearer end's position.
  JointMotion at(double time_s) const;

  std::uint64_t goal = 0;  // number of its action's goal; 0: none
  SegmentTolerance tolerance;

 private:
  double start_s_ = 0.0;
  double duration_s_ = 0.0;
  std::array<double, 6> coefficients_{};
};

/// Path of one joint: at least one segment, in the order of time.
using JointPath = std::vector<Segment>;

/// The segment in force at a time; the first one at times before its start.
const Segment& segment_at(const JointPath& path, double time_s);

/// A path at rest at `position` from `time_s` on.
JointPath resting_path(double time_s, double position);
/// A path from a motion at `time_s` to rest within `duration_s`.
JointPath stopping_path(double time_s, const JointMotion& motion, double duration_s);

/// Point that one joint is to pass, with its time.
struct TimedWaypoint {
  double time_s = 0.0;
  Waypoint waypoint;
};

/// Joins `path` to new points: follows `path` from `now_s` until `start_s`, then goes to the first
/// point and on through the others. With `is_wrapping` the new points are shifted by whole turns,
/// so that the first lies within half a turn. `goal` and `tolerance` are those of the new segments.
JointPath spliced_path(const JointPath& path, double now_s, double start_s,
                       std::vector<TimedWaypoint> points, bool is_wrapping, std::uint64_t goal,
                       const SegmentTolerance& tolerance);

/// Throws Error unless each point has a position for each of `joint_count` joints, velocities and
/// accelerations for all or none, finite numbers, and increasing times.
void check_points(const std::vector<devices::JointTrajectoryPoint>& points,
                  std::size_t joint_count);

}  // namespace ardee::control
