// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/core/time.h"
#include "ardee_sim/devices/robot.h"

namespace ardee {

/// A wrench on a link for a limited time: force and torque in world axes (N, N m), at a point in
/// the link's frame (m), with the link's pose of the time when the wrench is added.
struct Wrench {
  devices::Robot* robot = nullptr;
  std::size_t link = 0;
  Eigen::Vector3d force_W{0, 0, 0};
  Eigen::Vector3d torque_W{0, 0, 0};
  Eigen::Vector3d point_L{0, 0, 0};
  TimeNs start_ns = 0;
  TimeNs duration_ns = 0;  // negative: until cleared

  std::size_t part() const { return link; }
  /// The wrench at the centre of mass. Throws Error for one beyond the limits of the physics.
  Wrench accepted() const;
  void apply() const;
  void serialize(StateArchive& state) {
    state(link, force_W, torque_W, point_L, start_ns, duration_ns);
  }
};

/// An effort (N m or N) along a joint's first axis for a limited time.
struct JointEffort {
  devices::Robot* robot = nullptr;
  std::size_t joint = 0;
  double effort = 0.0;
  TimeNs start_ns = 0;
  TimeNs duration_ns = 0;  // negative: until cleared

  std::size_t part() const { return joint; }
  const JointEffort& accepted() const { return *this; }
  void apply() const { robot->dynamics().apply_joint_effort(joint, effort); }
  void serialize(StateArchive& state) { state(joint, effort, start_ns, duration_ns); }
};

/// The commands in force, each on a part of a robot: a link or a joint; several on one part add up.
template <typename Command>
class TimedCommands {
 public:
  /// Throws Error for a command that is not accepted, and changes nothing then.
  void add(const Command& command) { commands_.push_back(command.accepted()); }
  void clear(const devices::Robot& robot, std::size_t part) {
    erase_if([&](const Command& each) { return each.robot == &robot && each.part() == part; });
  }
  void clear(const devices::Robot& robot) {
    erase_if([&](const Command& each) { return each.robot == &robot; });
  }
  void clear_all() { commands_.clear(); }
  /// Applies the commands in force at `now_ns` and removes expired ones.
  void apply(TimeNs now_ns) {
    erase_if([now_ns](const Command& each) {
      return each.duration_ns >= 0 && now_ns >= each.start_ns + each.duration_ns;
    });
    for (const Command& each : commands_) {
      if (now_ns >= each.start_ns) each.apply();
    }
  }
  /// Saves or restores them; `robot_of` finds a robot by its number.
  void serialize(StateArchive& state,
                 const std::function<devices::Robot*(std::uint32_t)>& robot_of) {
    state.size_of(commands_);
    for (Command& each : commands_) {
      std::uint32_t robot = each.robot != nullptr ? each.robot->entity() : 0;
      state(robot, each);
      each.robot = robot_of(robot);
    }
  }

 private:
  template <typename Predicate>
  void erase_if(Predicate predicate) {
    commands_.erase(std::remove_if(commands_.begin(), commands_.end(), predicate), commands_.end());
  }

  std::vector<Command> commands_;
};

}  // namespace ardee
