// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "ardee_sim/core/time.h"
#include "ardee_sim/devices/robot.h"

namespace ardee {

/// A push on a link for a while; forces in world axes (N, N m), the point, in the link's frame (m),
/// as the link stands when the push is added.
struct Wrench {
  devices::Robot* robot = nullptr;
  std::size_t link = 0;
  Eigen::Vector3d force_W{0, 0, 0};
  Eigen::Vector3d torque_W{0, 0, 0};
  Eigen::Vector3d point_L{0, 0, 0};
  TimeNs start_ns = 0;
  TimeNs duration_ns = 0;  // negative: until cleared
};

/// The pushes in force; several on one body add up.
class Wrenches {
 public:
  /// Throws Error for a wrench beyond what the physics takes, and then keeps what there was.
  void add(const Wrench& wrench);
  void clear(const devices::Robot& robot, std::size_t link);
  void clear(const devices::Robot& robot);
  void clear_all() { wrenches_.clear(); }
  /// Applies those in force at `now_ns` and forgets those that are over.
  void apply(TimeNs now_ns);

 private:
  std::vector<Wrench> wrenches_;
};

}  // namespace ardee
