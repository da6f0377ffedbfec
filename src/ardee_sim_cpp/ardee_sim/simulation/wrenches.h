// SPDX-License-Identifier: MIT
#pragma once

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
};

/// The wrenches in force; several on one body add up.
class Wrenches {
 public:
  /// Throws Error for a wrench beyond the limits of the physics, and changes nothing then.
  void add(const Wrench& wrench);
  void clear(const devices::Robot& robot, std::size_t link);
  void clear(const devices::Robot& robot);
  void clear_all() { wrenches_.clear(); }
  /// Applies the wrenches in force at `now_ns` and removes expired ones.
  void apply(TimeNs now_ns);
  /// Saves or restores them; `robot_of` finds a robot by its number.
  void serialize(StateArchive& state,
                 const std::function<devices::Robot*(std::uint32_t)>& robot_of);

 private:
  std::vector<Wrench> wrenches_;
};

}  // namespace ardee
