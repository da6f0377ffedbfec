// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/trajectory.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "ardee_sim/controllers/joint_error.h"
#include "ardee_sim/core/error.h"

namespace ardee::control {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;

std::array<double, 6> line(double from, double to, double duration_s) {
  return {from, duration_s > 0.0 ? (to - from) / duration_s : 0.0};
}

std::array<double, 6> cubic(const Waypoint& from, const Waypoint& to, double t) {
  const double v0 = *from.velocity;
  const double v1 = *to.velocity;
  if (t <= 0.0) return {from.position, v0};
  const double way = to.position - from.position;
  return {from.position, v0, (3.0 * way - (2.0 * v0 + v1) * t) / (t * t),
          (-2.0 * way + (v0 + v1) * t) / (t * t * t)};
}

std::array<double, 6> quintic(const Waypoint& from, const Waypoint& to, double t) {
  const double v0 = *from.velocity;
  const double v1 = *to.velocity;
  const double a0 = *from.acceleration;
  const double a1 = *to.acceleration;
  if (t <= 0.0) return {from.position, v0, 0.5 * a0};
  const double way = to.position - from.position;
  const double t2 = t * t;
  const double t3 = t2 * t;
  return {from.position,
          v0,
          0.5 * a0,
          (20.0 * way - (8.0 * v1 + 12.0 * v0) * t - (3.0 * a0 - a1) * t2) / (2.0 * t3),
          (-30.0 * way + (14.0 * v1 + 16.0 * v0) * t + (3.0 * a0 - 2.0 * a1) * t2) / (2.0 * t3 * t),
          (12.0 * way - 6.0 * (v1 + v0) * t - (a0 - a1) * t2) / (2.0 * t3 * t2)};
}

/// Turn to add to points so that `next` lies within half a turn of `last`.
double wrap_offset(double last, double next) {
  constexpr double kTie = 1e-9;  // exactly half a turn keeps the numbers' direction
  double turn = shortest_turn(next - last);
  if (std::abs(std::abs(turn) - kHalfTurn) < kTie) turn = std::copysign(kHalfTurn, next - last);
  return last + turn - next;
}

bool is_within(double error, double tolerance) {
  return tolerance <= 0.0 || std::abs(error) <= tolerance;
}

/// The index of the segment in force, 0 before the first begins.
std::size_t index_at(const JointPath& path, double time_s) {
  const auto after = std::upper_bound(
      path.begin(), path.end(), time_s,
      [](double time, const Segment& segment) { return time < segment.start_s(); });
  return after == path.begin() ? 0 : static_cast<std::size_t>(after - path.begin()) - 1;
}

void check_numbers(const std::vector<double>& numbers, std::size_t joint_count, bool is_required,
                   const std::string& place) {
  if (numbers.empty() && !is_required) return;
  if (numbers.size() != joint_count) {
    throw Error(place + ": found " + std::to_string(numbers.size()) + " numbers, expected " +
                std::to_string(joint_count) + ", one a joint");
  }
  for (const double number : numbers) {
    if (!std::isfinite(number)) throw Error(place + ": found a number that is not finite");
  }
}

}  // namespace

bool StateTolerance::allows(const JointMotion& error) const {
  return is_within(error.position, position) && is_within(error.velocity, velocity) &&
         is_within(error.acceleration, acceleration);
}

Segment::Segment(double start_s, const Waypoint& start, double end_s, const Waypoint& end)
    : start_s_(start_s), duration_s_(end_s - start_s) {
  const bool has_velocities = start.velocity && end.velocity;
  if (has_velocities && start.acceleration && end.acceleration) {
    coefficients_ = quintic(start, end, duration_s_);
  } else if (has_velocities) {
    coefficients_ = cubic(start, end, duration_s_);
  } else {
    coefficients_ = line(start.position, end.position, duration_s_);
  }
}

JointMotion Segment::at(double time_s) const {
  const double t = std::min(std::max(time_s - start_s_, 0.0), duration_s_);
  const auto& c = coefficients_;
  const double position = ((((c[5] * t + c[4]) * t + c[3]) * t + c[2]) * t + c[1]) * t + c[0];
  if (time_s < start_s_ || time_s >= end_s()) return {position, 0.0, 0.0};
  return {position, (((5.0 * c[5] * t + 4.0 * c[4]) * t + 3.0 * c[3]) * t + 2.0 * c[2]) * t + c[1],
          ((20.0 * c[5] * t + 12.0 * c[4]) * t + 6.0 * c[3]) * t + 2.0 * c[2]};
}

const Segment& segment_at(const JointPath& path, double time_s) {
  return path[index_at(path, time_s)];
}

JointPath resting_path(double time_s, double position) {
  const Waypoint rest(position, 0.0, 0.0);
  return {Segment(time_s, rest, time_s, rest)};
}

JointPath stopping_path(double time_s, const JointMotion& motion, double duration_s) {
  // A path that ends at its start with the opposite velocity is at rest half way.
  const Waypoint start(motion.position, motion.velocity, 0.0);
  const Waypoint back(motion.position, -motion.velocity, 0.0);
  const Segment both_ways(time_s, start, time_s + 2.0 * duration_s, back);
  const double end_s = time_s + duration_s;
  return {Segment(time_s, start, end_s, Waypoint(both_ways.at(end_s)))};
}

JointPath spliced_path(const JointPath& path, double now_s, double start_s,
                       std::vector<TimedWaypoint> points, bool is_wrapping, std::uint64_t goal,
                       const SegmentTolerance& tolerance) {
  const double bridge_s = std::max(start_s, now_s);
  const JointMotion last = segment_at(path, bridge_s).at(bridge_s);
  const double offset =
      is_wrapping ? wrap_offset(last.position, points.front().waypoint.position) : 0.0;
  for (TimedWaypoint& point : points) point.waypoint.position += offset;

  JointPath spliced(path.begin() + static_cast<std::ptrdiff_t>(index_at(path, now_s)),
                    path.begin() + static_cast<std::ptrdiff_t>(index_at(path, bridge_s)) + 1);
  TimedWaypoint from{bridge_s, Waypoint(last)};
  for (const TimedWaypoint& to : points) {
    Segment& segment = spliced.emplace_back(from.time_s, from.waypoint, to.time_s, to.waypoint);
    segment.goal = goal;
    segment.tolerance = tolerance;
    from = to;
  }
  return spliced;
}

void check_points(const std::vector<devices::JointTrajectoryPoint>& points,
                  std::size_t joint_count) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const devices::JointTrajectoryPoint& point = points[i];
    const std::string place = "points[" + std::to_string(i) + "]";
    check_numbers(point.positions, joint_count, true, place + ".positions");
    check_numbers(point.velocities, joint_count, false, place + ".velocities");
    check_numbers(point.accelerations, joint_count, false, place + ".accelerations");
    if (i > 0 && !(point.time_from_start_s > points[i - 1].time_from_start_s)) {
      throw Error(place + ".time_from_start: found " + std::to_string(point.time_from_start_s) +
                  " s, expected more than that of the point before, " +
                  std::to_string(points[i - 1].time_from_start_s) + " s");
    }
  }
}

}  // namespace ardee::control
