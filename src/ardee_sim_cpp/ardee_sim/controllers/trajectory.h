// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "ardee_sim/devices/command.h"

namespace ardee::control {

/// How a joint moves at one time: rad or m, and their derivatives.
struct JointMotion {
  double position = 0.0;
  double velocity = 0.0;
  double acceleration = 0.0;
};

/// An end of a segment, of which less may be known.
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

/// How far a joint may be from where it shall be; 0: as far as it likes.
struct StateTolerance {
  double position = 0.0;
  double velocity = 0.0;
  double acceleration = 0.0;

  bool allows(const JointMotion& error) const;
};

struct SegmentTolerance {
  StateTolerance path;
  StateTolerance goal;
  double goal_time_s = 0.0;  // for which it may be outside of `goal` after the end
};

/// The way of one joint between two times, by the polynomial of the least degree that has what both
/// ends know: positions only a line, velocities a cubic, accelerations a quintic.
class Segment {
 public:
  /// start_s <= end_s.
  Segment(double start_s, const Waypoint& start, double end_s, const Waypoint& end);

  double start_s() const { return start_s_; }
  double end_s() const { return start_s_ + duration_s_; }
  /// Before it begins and from its end on: at rest, at the nearer end's position.
  JointMotion at(double time_s) const;

  std::uint64_t goal = 0;  // of an action that it belongs to; 0: of none
  SegmentTolerance tolerance;

 private:
  double start_s_;
  double duration_s_;
  std::array<double, 6> coefficients_{};
};

/// The way of one joint: segments in the order of their times, at least one.
using JointPath = std::vector<Segment>;

/// The segment in force at a time, the first one before it begins.
const Segment& segment_at(const JointPath& path, double time_s);

/// `time_s`, from then on at rest at `position`.
JointPath resting_path(double time_s, double position);
/// From a motion at `time_s` to rest within `duration_s`.
JointPath stopping_path(double time_s, const JointMotion& motion, double duration_s);

/// Points that one joint shall pass, by their times.
struct TimedWaypoint {
  double time_s = 0.0;
  Waypoint waypoint;
};

/// What `path` does from `now_s` until the new points begin at `start_s`, from there to the first
/// of them, and on through them. `is_wrapping`: the new points are turned by whole turns, so that
/// the first lies within half a turn. `goal` and `tolerance` are those of the new segments.
JointPath spliced_path(const JointPath& path, double now_s, double start_s,
                       std::vector<TimedWaypoint> points, bool is_wrapping, std::uint64_t goal,
                       const SegmentTolerance& tolerance);

/// Throws Error unless each point has a position for each of `joint_count` joints, velocities and
/// accelerations for all or none, finite numbers, and times that rise.
void check_points(const std::vector<devices::JointTrajectoryPoint>& points,
                  std::size_t joint_count);

}  // namespace ardee::control
